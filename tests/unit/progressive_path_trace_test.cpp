#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "base/interrupt.h"
#include "experiment/progressive_reference.h"
#include "tests/support/all_passes.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

/// Path-traced references that grow sample by sample.
namespace voxray::test {
namespace {

using namespace std::chrono_literals;

class GrowingPathTrace : public testing::Test {
 protected:
    void SetUp() override { useCache("grown"); }

    /// Opens a session with a cache of its own.
    void useCache(const std::string& name) {
        setenv("VOXRAY_CACHE", (root_ / name).c_str(), 1);
        session_.reset();
        session_.emplace(DeviceOptions{}, sourceRoot(), std::vector<std::filesystem::path>{});
    }
    Study study(uint32_t spp, const std::string& camera, uint32_t width = 40) {
        const std::string text = fmt::format(
            "name: grown\nscene: {{builtin: cornell, camera: {{{}}}}}\nimage: {{width: {}, height: 24}}\nseed: 7\n"
            "graph: [{{pass: path_trace, spp: 1}}]\nreference: {{pass: path_trace, spp: {}, bounces: 3}}\n",
            camera, width, spp);
        Study study = makeStudy(parseExperiment(text, "grown.yaml"), registry_);
        Variant& variant = study.variants.front();
        variant.referenceHash = session_->referenceHashOf(study, variant.setup);
        return study;
    }

    static constexpr const char* kFront = "position: [0, 1, 3], target: [0, 1, 0], fov_deg: 50";
    static constexpr const char* kSide = "position: [0.3, 1, 3], target: [0, 1, 0], fov_deg: 50";
    const Registry registry_ = allPasses();
    const TemporaryFolder root_;
    std::optional<Session> session_;
};

TEST_F(GrowingPathTrace, HasTheBitsOfOneThatIsRenderedAtOnce) {
    std::vector<ReferenceImages> grown;
    {
        ProgressiveReference reference(*session_);
        // The camera alone moves, then the size changes, too; the second is not finished at first
        reference.advance(study(16, kSide), 0ms);
        for (const uint32_t spp : {16u, 7u}) {
            reference.advance(study(spp, kFront), 1h);
            grown.push_back(*reference.images());
        }
        reference.advance(study(16, kSide, 20), 1h);
        grown.push_back(*reference.images());
    }
    useCache("at-once");
    for (const auto& [spp, camera, width, right] :
         {std::tuple{16u, kFront, 40u, 0}, {7u, kFront, 40u, 1}, {16u, kSide, 20u, 2}}) {
        const Study study = this->study(spp, camera, width);
        const ReferenceImages& whole = session_->reference(study, study.variants.front().setup, [](double) {});
        EXPECT_FALSE(whole.cached);
        const ReferenceImages& images = grown[size_t(right)];
        for (const auto& [a, b] : {std::pair{&images.final, &whole.final}, {&images.indirect, &whole.indirect}}) {
            EXPECT_EQ(a->a.data, b->a.data);
            EXPECT_EQ(a->b.data, b->b.data);
            EXPECT_EQ(a->mean.data, b->mean.data);
        }
    }
}

TEST_F(GrowingPathTrace, ItsNoiseFallsLikeOneOverTheRootOfItsSamples) {
    ProgressiveReference reference(*session_);
    const Study all = study(64, kFront);
    while (reference.samples() < 4) reference.advance(all, 0ms);
    const double early = reference.noise().at("nrmse");
    reference.advance(all, 1h);
    // Sobol points converge faster than random ones
    EXPECT_LT(reference.noise().at("nrmse"), early / 3);
    EXPECT_GT(reference.noise().at("nrmse"), early / 64);
}

TEST_F(GrowingPathTrace, IsCancelledWithinASample) {
    const std::string text =
        "name: large\nscene: {builtin: cornell}\nimage: {width: 2048, height: 2048}\n"
        "graph: [{pass: path_trace, spp: 1}]\nreference: {pass: path_trace, spp: 64, bounces: 64}\n";
    Study large = makeStudy(parseExperiment(text, "large.yaml"), registry_);
    large.variants.front().referenceHash = "large";
    ProgressiveReference reference(*session_);
    std::jthread canceller([] {
        std::this_thread::sleep_for(100ms);
        requestCancel();
    });
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THROW(reference.advance(large, 1h), Interrupted);
    canceller.join();
    clearCancel();
    EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);  // All samples take minutes
    EXPECT_LT(reference.samples(), 64u);
    EXPECT_FALSE(reference.hasFailed());
}

}  // namespace
}  // namespace voxray::test
