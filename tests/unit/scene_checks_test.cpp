// What is said of scenes before anything is rendered: pixels of skies, lights that take long.
#include <gtest/gtest.h>

#include <limits>

#include "experiment/checks/cost.h"
#include "experiment/scene_files.h"
#include "scene/load.h"
#include "tests/support/errors.h"

namespace voxray {
namespace {

TEST(EnvironmentMap, NamesThePixelThatIsNoRadiance) {
    const auto refusal = [](float value) {
        ImageF map(4, 2, 3, 1.0f);
        map.data[3 * (1 * 4 + 2) + 1] = value;
        return errorOf([&] { checkRadiance(map, "sky.exr"); });
    };
    EXPECT_CONTAINS(refusal(-1), "sky.exr: its pixel in column 2 and row 1, from the upper left, is (1, -1, 1)");
    EXPECT_CONTAINS(refusal(std::numeric_limits<float>::infinity()), "half floats end at 65504");
    EXPECT_CONTAINS(refusal(std::numeric_limits<float>::quiet_NaN()), "1 of its 24 values");
    EXPECT_NO_THROW(checkRadiance(ImageF(4, 2, 3, 0.0f), "sky.exr"));
}

TEST(ShadowRayCost, WarnsOfManyLightsThatTakeLong) {
    SceneState state = evaluate(makeBuiltinScene("plane", {}), 0);
    Graph::PassInfo pass{"shadows", "direct_shadow_rays", Phase::Frame, 0, {"x.yaml", 7}, 0, false};
    const auto said = [&](size_t lights, uint64_t rays) {
        state.lights.resize(lights);
        pass.lightRays = rays;
        Diagnostics found;
        ShadowRayCost(state).check({&pass, 1}, found);
        return found.empty() ? "" : found.front().str();
    };
    EXPECT_CONTAINS(said(500, 1'000'000'000'000), "x.yaml:7: shadows: 500 lights take 1000000 million rays");
    EXPECT_EQ(said(500, 1000), "");
    EXPECT_EQ(said(3, 1'000'000'000'000), "");
}

}  // namespace
}  // namespace voxray
