#include <nlohmann/json.hpp>

#include "experiment_fakes.h"
#include "image/image.h"
#include "tests/support/errors.h"

using namespace voxray;
using namespace voxray::fakes;
namespace fs = std::filesystem;

/// Sequences, masks and AOVs of whole runs, on fakes with closed forms: the reference is 1 everywhere.
class PartsTest : public RunTest {
 protected:
    RunSummary runWith(const std::vector<std::string>& assignments, bool aovs = false) const {
        RunOptions o = options();
        o.aovs = aovs;
        return runExperiment(parseExperiment(config(""), "fake.yaml", {"", assignments}), o, registry());
    }
    double number(const std::string& column) const { return std::stod(cell("default", column)); }
    nlohmann::json manifest() const { return nlohmann::json::parse(readTextFile(root_ / "out" / "manifest.json")); }
    /// The lines of frames.csv.
    std::vector<std::vector<std::string>> frames() const {
        std::vector<std::vector<std::string>> rows;
        std::istringstream lines(readTextFile(root_ / "out" / "frames.csv"));
        for (std::string line; std::getline(lines, line);) rows.push_back(split(line));
        return rows;
    }
};

TEST_F(PartsTest, ASecondSeedTellsBiasFromNoise) {
    // Images of 1.5 ± 0.25 against a reference of 1: a bias of (0.75 · 0.25)^½, for two images are no mean
    EXPECT_EQ(runWith({"constant.value=1.5", "constant.noise=0.25", "measure.second_seed=true"}).exitStatus(), 0);
    EXPECT_NEAR(number("bias_nrmse"), std::sqrt(0.75 * 0.25), 1e-6);
    EXPECT_NEAR(number("noise_nrmse"), 0.25 * std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(number("indirect_noise_nrmse"), number("noise_nrmse"), 1e-6);
    EXPECT_EQ(manifest().at("seed_metrics").size(), 2u);

    // The second image is not timed, and what is timed and scored does not change with it
    const std::string error = cell("default", "nrmse"), rays = cell("default", "rays");
    const int runs = Constant::runs;
    EXPECT_EQ(runWith({"constant.value=1.5", "constant.noise=0.25"}).exitStatus(), 0);
    EXPECT_EQ(runs - (Constant::runs - runs), 2);  // The second seed took a warm-up frame and frame 0.
    EXPECT_EQ(cell("default", "nrmse"), error);
    EXPECT_EQ(cell("default", "rays"), rays);
    EXPECT_EQ(readTextFile(root_ / "out" / "results.csv").find("noise_nrmse"), std::string::npos);
}

TEST_F(PartsTest, AlternatingFramesFlickerByAKnownAmount) {
    // Frames of 1.25 and 0.75 in turn: four steps of ±0.5, whose mean is 0.
    EXPECT_EQ(runWith({"constant.flicker=0.25", "measure.frames=5", "measure.compare_every=1"}).exitStatus(), 0);
    EXPECT_NEAR(number("temporal_flicker"), 0.5, 1e-6);
    EXPECT_NEAR(number("temporal_nrmse"), 0.5, 1e-6);
    EXPECT_NEAR(number("temporal_bias"), 0, 1e-6);
    EXPECT_NEAR(number("indirect_temporal_flicker"), 0.5, 1e-6);
    EXPECT_NEAR(number("temporal_flicker_low"), 0.5, 1e-6);
    EXPECT_EQ(Truth::runs, 1);  // Nothing moves: one reference for all frames.

    // Each frame has its own scores; the first one those of results.csv and no step before it.
    const auto rows = frames();
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_EQ(rows[0][0], "variant");
    EXPECT_EQ(rows[0][2], "nrmse");
    EXPECT_EQ(rows[0].back(), "indirect_temporal_nrmse");
    for (size_t i = 1; i < rows.size(); ++i) EXPECT_NEAR(std::stod(rows[i][2]), 0.25, 1e-6) << i;
    EXPECT_EQ(rows[1].back(), "");
    EXPECT_NEAR(std::stod(rows[2].back()), 0.5, 1e-6);
    EXPECT_EQ(cell("default", "nrmse"), rows[1][2]);

    // A preview of each is kept.
    const auto hasPreview = [&](int frame) {
        return fs::exists(root_ / "out/images/default/frames" / ("final." + std::to_string(frame) + ".png"));
    };
    EXPECT_TRUE(hasPreview(0) && hasPreview(4));
    EXPECT_FALSE(hasPreview(5));

    // Every second frame is the same image.
    runWith({"constant.flicker=0.25", "measure.frames=5", "measure.compare_every=2"});
    EXPECT_EQ(number("temporal_nrmse"), 0);
    EXPECT_EQ(frames().size(), 4u);

    // Without comparison there is no such file, of an earlier run either.
    runWith({});
    EXPECT_FALSE(fs::exists(root_ / "out" / "frames.csv"));
    EXPECT_FALSE(hasPreview(0));
    EXPECT_EQ(cell("default", "temporal_nrmse"), "absent");
}

TEST_F(PartsTest, EachFrameThatMovesHasAReferenceOfItsOwn) {
    const auto camera = [](const std::string& move) {
        return "scene.camera={position: [0, 1, 3], target: [0, 1, 0], move: " + move + "}";
    };
    const std::vector<std::string> measure{"measure.frames=4", "measure.compare_every=1"};
    const auto run = [&](const std::string& setting) {
        EXPECT_EQ(runWith({measure[0], measure[1], setting}).exitStatus(), 0);
        return Truth::runs;
    };
    EXPECT_EQ(run(camera("[0.1, 0, 0]")), 4);
    EXPECT_EQ(number("temporal_nrmse"), 0);
    EXPECT_EQ(run(camera("[0.1, 0, 0]")), 4);  // From the cache.
    EXPECT_EQ(run(camera("[0.2, 0, 0]")), 7);  // Frame 0 is the same.
    EXPECT_EQ(run(camera("[0, 0, 0]")), 7);    // So is a sequence that stands still.
    const auto path = [&](const std::string& keys) { return camera("[0, 0, 0], path: [" + keys + "]"); };
    const std::string key = "{frame: 2, position: [0, 1, 2], target: [0, 1, 0]}";
    EXPECT_EQ(run(path(key)), 10);
    EXPECT_EQ(run(path(key)), 10);
    EXPECT_EQ(run(path(key + ", {frame: 3, position: [1, 1, 2], target: [0, 1, 0]}")), 13);
    EXPECT_EQ(run("scene.lights=[{point: [0, 1, 0], move: [0.1, 0, 0]}]"), 17);
    EXPECT_EQ(run("scene.lights=[{point: [0, 1, 0], move: [0.2, 0, 0]}]"), 20);
    EXPECT_NE(Truth::seeds[18], Truth::seeds[19]);
}

TEST_F(PartsTest, ResumeTakesFramesOver) {
    const std::vector<std::string> measure{"constant.flicker=0.25", "measure.frames=3", "measure.compare_every=1"};
    runWith(measure);
    const std::string before = readTextFile(root_ / "out" / "frames.csv");
    RunOptions o = options();
    o.resume = true;
    const RunSummary summary = runExperiment(parseExperiment(config(""), "fake.yaml", {"", measure}), o, registry());
    EXPECT_EQ(summary.resumed, 1u);
    EXPECT_EQ(readTextFile(root_ / "out" / "frames.csv"), before);
}

TEST_F(PartsTest, TooManyImagesForTheHostAreRefused) {
    EXPECT_EQ(runWith({"image.width=8192", "image.height=8192", "measure.frames=9", "measure.compare_every=1",
                       "reference=null"})
                  .exitStatus(),
              1);
    EXPECT_NE(cell("default", "error").find("raise measure.compare_every"), std::string::npos);
    EXPECT_EQ(Constant::runs, 0);
}

TEST_F(PartsTest, MasksHaveTheirOwnScores) {
    EXPECT_EQ(runWith({"image={width: 32, height: 32}", "constant.value=0.5",
                       "measure.masks={box: {object: tall box}, red: {material: red}, mirrors: {min_metallic: 0.9}}"})
                  .exitStatus(),
              0);
    EXPECT_NEAR(number("nrmse@box"), 0.5, 1e-6);
    EXPECT_NEAR(number("indirect_mean_ratio@red"), 0.5, 1e-6);

    // What selects nothing has no scores, and the reader is told.
    EXPECT_EQ(cell("default", "nrmse@mirrors"), "");
    const auto json = manifest();
    EXPECT_CONTAINS(json["warnings"].dump(),
                    "measure.masks.mirrors: it selects no pixel and has no scores: "
                    "no surface of the scene meets all of its conditions (default)");

    // Its pixels, its part of the image, and what noise and a black image score there.
    EXPECT_EQ(json["config"]["measure"]["masks"]["box"]["object"], "tall box");
    const double fraction = json["reference"]["mask_fractions"]["box"].get<double>();
    EXPECT_GT(fraction, 0.03);
    EXPECT_LT(fraction, 0.3);
    const ImageF picture = readImage(root_ / "out" / "images" / "reference" / "mask.box.png");
    double sum = 0;
    for (const float value : picture.data) sum += value;
    EXPECT_NEAR(sum / double(picture.data.size()), fraction, 1e-6);
    EXPECT_EQ(json["reference"]["flip@box_noise"], 0);
    EXPECT_NEAR(number("nrmse_high@box"), 0.5, 1e-6);
    EXPECT_NEAR(json["baselines"]["black"]["nrmse@box"].get<double>(), 1, 1e-6);
}

TEST_F(PartsTest, NamesThatTheSceneLacksAreSuggestedBeforeAnythingIsRendered) {
    EXPECT_CONTAINS(errorOf<UsageError>([&] { runWith({"measure.masks={box: {object: tal box}}"}); }), "'tall box'");
    EXPECT_CONTAINS(errorOf<UsageError>([&] { runWith({"measure.masks={wall: {material: greeen}}"}); }), "'green'");
    EXPECT_EQ(Truth::runs, 0);
}

TEST_F(PartsTest, AovsAreWrittenByTheirNames) {
    EXPECT_EQ(runWith({"graph=[{pass: layers}, {pass: constant}]"}, true).exitStatus(), 0);
    const fs::path file = root_ / "out" / "images" / "default" / "aovs.layers.exr";
    const ImageF image = readImage(file);
    EXPECT_EQ(image.width, 8u);
    EXPECT_EQ(image.data[0], 0.5f);  // Half floats, as R, G and B.
    EXPECT_EQ(image.data[1], 0.25f);
    EXPECT_EQ(image.data[2], 2.0f);
    const std::string bytes = readTextFile(file);
    for (const char* channel : {"P.X", "P.Y", "P.Z", "Z", "id", "material_id"})
        EXPECT_NE(bytes.find(std::string(channel) + '\0'), std::string::npos) << channel;

    // Only where they are asked for.
    runWith({"graph=[{pass: layers}, {pass: constant}]"});
    EXPECT_FALSE(fs::exists(file));
}
