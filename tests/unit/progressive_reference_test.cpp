#include "experiment/progressive_reference.h"

#include "base/interrupt.h"
#include "experiment_fakes.h"
#include "tests/support/errors.h"

using namespace voxray;
using namespace voxray::fakes;
using namespace std::chrono_literals;

/// A reference that is rendered sample by sample, on fakes with closed forms.
class GrowingReference : public RunTest {
 protected:
    void SetUp() override {
        RunTest::SetUp();
        session_.emplace(DeviceOptions{}, test::sourceRoot(), std::vector<std::filesystem::path>{});
        reference_.emplace(*session_);
    }

    Study study(const std::string& rest = {}, const std::string& truth = "noise: 0.25") {
        std::string text = config(rest);
        const std::string pass = "pass: truth";
        text.replace(text.find(pass), pass.size(), pass + ", " + truth);
        Study study = makeStudy(parseExperiment(text, "fake.yaml"), registry_);
        Variant& variant = study.variants.front();
        variant.referenceHash = session_->referenceHashOf(study, variant.setup);
        return study;
    }
    /// Renders a sample a pixel.
    void advance(const Study& study) { reference_->advance(study, 0ms); }

    const Registry registry_ = registry();
    std::optional<Session> session_;
    std::optional<ProgressiveReference> reference_;
};

TEST_F(GrowingReference, TellsItsSamplesAndItsNoise) {
    const Study four = study();
    reference_->follow(four);
    EXPECT_EQ(reference_->samples(), 0u);
    EXPECT_EQ(reference_->of(), 4u);
    EXPECT_TRUE(reference_->noise().empty());
    advance(four);
    EXPECT_EQ(reference_->samples(), 1u);
    EXPECT_EQ(reference_->images(), nullptr);  // A half has none
    advance(four);
    ASSERT_NE(reference_->images(), nullptr);
    EXPECT_EQ(reference_->images()->final.mean.data[0], 1.0f);
    EXPECT_EQ(reference_->images()->indirect.b.data[0], 0.625f);
    EXPECT_EQ(reference_->images()->hash, four.variants.front().referenceHash);
    EXPECT_DOUBLE_EQ(reference_->noise().at("nrmse"), 0.25);
    EXPECT_DOUBLE_EQ(reference_->noise().at("indirect_nrmse"), 0.25);
    EXPECT_FALSE(reference_->isWhole());
    reference_->advance(four, 1h);
    EXPECT_TRUE(reference_->isWhole());
    EXPECT_EQ(reference_->samples(), 4u);
    EXPECT_EQ(Truth::runs, 4);
    advance(four);
    EXPECT_EQ(Truth::runs, 4);
}

TEST_F(GrowingReference, WholeItIsTheOneOfARunAndCached) {
    const Study all = study();
    reference_->advance(all, 1h);
    const ReferenceImages grown = *reference_->images();
    const ReferenceImages& cached = session_->reference(all, all.variants.front().setup, [](double) {});
    EXPECT_TRUE(cached.cached);
    EXPECT_EQ(Truth::runs, 4);
    EXPECT_EQ(cached.final.mean.data, grown.final.mean.data);
    EXPECT_EQ(cached.indirect.b.data, grown.indirect.b.data);

    ProgressiveReference another(*session_);
    another.follow(all);
    EXPECT_TRUE(another.isWhole());
    EXPECT_EQ(another.samples(), 4u);
    EXPECT_EQ(another.images()->final.a.data, grown.final.a.data);
    another.advance(all, 1h);
    EXPECT_EQ(Truth::runs, 4);
}

TEST_F(GrowingReference, StaysWherePassesAloneChangeAndBeginsAnewElsewhere) {
    advance(study());
    advance(study("sweep: {constant.value: [0.5]}\n"));
    EXPECT_EQ(reference_->samples(), 2u);

    advance(study("seed: 9\n"));
    EXPECT_EQ(reference_->samples(), 1u);
    advance(study("seed: 9\n"));
    EXPECT_EQ(reference_->samples(), 2u);
    advance(study("seed: 9\n", "noise: 0.5"));
    EXPECT_EQ(reference_->samples(), 1u);
    advance(study("seed: 9\n", "spp: 8, noise: 0.5"));
    EXPECT_EQ(reference_->samples(), 1u);
    EXPECT_EQ(reference_->of(), 8u);
}

TEST_F(GrowingReference, AnErrorIsToldAgainAndTriedNoMore) {
    const Study failing = study({}, "fail: true");
    EXPECT_CONTAINS(errorOf<Error>([&] { advance(failing); }), "reference: no truth");
    EXPECT_TRUE(reference_->hasFailed());
    EXPECT_CONTAINS(errorOf<Error>([&] { advance(failing); }), "reference: no truth");
    advance(study());
    EXPECT_EQ(reference_->samples(), 1u);
    EXPECT_FALSE(reference_->hasFailed());
}

TEST_F(GrowingReference, ACancelKeepsWhatIsThere) {
    const Study all = study();
    advance(all);
    requestCancel();
    EXPECT_THROW(reference_->advance(all, 1h), Interrupted);
    clearCancel();
    EXPECT_EQ(reference_->samples(), 1u);
    EXPECT_FALSE(reference_->hasFailed());
    reference_->advance(all, 1h);
    EXPECT_TRUE(reference_->isWhole());
    EXPECT_EQ(reference_->images()->final.b.data[0], 1.25f);
}
