#include <gtest/gtest.h>

#include <random>

#include "config/sweep.h"

using namespace voxray;

/// The config reader runs under AddressSanitizer and UndefinedBehaviorSanitizer in every build type: see
/// tests/mutation.cmake.
namespace {

const std::string kSeed = R"(name: mutate_me   # comment
scene: {builtin: cornell, lights: [{point: [0, 1.5, 0], intensity: [5, 5, 5]}, {spot: [0, 1, 0], outer_deg: 30}],
        camera: {position: [-9, 1.2, -0.3], target: [0, 3, 0], fov_deg: 60}, environment: {map: a.exr, scale: 2},
        add: [{file: a.glb, transform: {translate: [0, 1, 0], scale: 2}, material: {metallic: 1}}, {builtin: plane, height: 2}],
        override: {grey: {base_color: [1, 0.5, 0], roughness: 0}}}
image: {width: 640, height: 360, exposure_stops: 0.5}
seed: 7
graph: &graph
  - {pass: gbuffer}
  - {pass: voxelize, method: dominant_axis, resolution: 128}
  - pass: gather
    inputs: {levels: "voxelize.levels"}
reference: {pass: path_trace, spp: 1024}
sweep:
  voxelize.resolution: [64, 128]
  gather: [a, {pass: b, write: max}, [c, {pass: d, rays: 3}]]
  scene.camera.fov_deg: [10, 20.5]
measure: {frames: 20, warmup: 3, metrics: [flip, ssim]}
profiles:
  small: {image: {width: 160}, reference.spp: 64, sweep.voxelize.resolution: [32], scene.time: 1}
)";

/// One or two changes: a byte, a cut, a doubled range, or a word of YAML somewhere.
std::string mutate(std::mt19937& random) {
    static const std::vector<std::string> words{"[",
                                                "]",
                                                "{",
                                                "}",
                                                ":",
                                                ": ",
                                                "\n",
                                                "\n- ",
                                                "&a ",
                                                "*graph",
                                                "*a",
                                                "null",
                                                "~",
                                                "-1",
                                                "1e999",
                                                ".nan",
                                                "99999999999999999999",
                                                "0x10",
                                                "!!str ",
                                                "'",
                                                "\"",
                                                "|\n",
                                                ">",
                                                "? ",
                                                "---\n",
                                                "...\n",
                                                "%YAML 9.9\n",
                                                "\t",
                                                std::string(1, '\0'),
                                                "\xff\xfe",
                                                "\xc3\xa9",
                                                "<<: *graph\n",
                                                "scene.",
                                                "..",
                                                "sweep.sweep.x",
                                                "profiles"};
    std::string text = kSeed;
    const auto below = [&](size_t n) { return size_t(random() % std::max<size_t>(n, 1)); };
    for (size_t i = 0, n = 1 + below(2); i < n; ++i) {
        const size_t at = below(text.size() + 1), length = below(std::min<size_t>(40, text.size() - at) + 1);
        switch (below(5)) {
            case 0:
                if (at < text.size()) text[at] = char(random() & 0xff);
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(at, length));
                break;
            case 3:
                text.insert(at, words[below(words.size())]);
                break;
            case 4:
                text.replace(at, length, words[below(words.size())]);
                break;
        }
    }
    return text;
}

}  // namespace

TEST(ConfigMutation, ReadsOrGivesOneUsageError) {
    std::mt19937 random(20240607);
    int accepted = 0, refused = 0;
    ASSERT_NO_THROW(expandSweep(parseExperiment(kSeed, "seed.yaml", {"small", {}}), {}));
    for (int i = 0; i < 2000; ++i) {
        const std::string text = mutate(random);
        try {
            expandSweep(parseExperiment(text, "mutated.yaml"), {});
            ++accepted;
        } catch (const UsageError& error) {
            ++refused;
            const std::string message = error.what();
            EXPECT_FALSE(message.empty());
            EXPECT_EQ(message.rfind("mutated.yaml", 0), 0u) << message;
        } catch (const std::exception& error) {
            FAIL() << "mutation " << i << " gave " << error.what() << " for:\n" << text;
        }
    }
    // The mutations are neither all harmless nor all fatal
    EXPECT_GT(accepted, 100);
    EXPECT_GT(refused, 500);
}

TEST(ConfigMutation, Assignments) {
    std::mt19937 random(7);
    const std::string alphabet = "image.width=sceneswp:[]{}&*'\"0123 -null.\n";
    for (int i = 0; i < 1000; ++i) {
        std::string assignment;
        for (size_t k = 0, n = random() % 24; k < n; ++k) assignment += alphabet[random() % alphabet.size()];
        try {
            parseExperiment(kSeed, "seed.yaml", {"", {assignment}});
        } catch (const UsageError&) {
        }
    }
}
