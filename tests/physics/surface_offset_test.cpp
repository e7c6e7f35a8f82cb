// Rays begin off surfaces by the error of the coordinates at hand: what lies far away changes nothing.
#include <gtest/gtest.h>

#include "scene/shapes.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

/// A sheet `gap` above ground of half that width, in the sun, which leaves its shadow next to it.
std::shared_ptr<SceneState> sheetOverGround(float groundHalf, float gap, float strayAt = 0) {
    SceneBuilder builder("sheet over ground");
    const uint32_t gray = builder.lambert("gray", glm::vec3(0.5f));
    const float g = groundHalf;
    builder.quad("ground", {-g, 0, g}, {2 * g, 0, 0}, {0, 0, -2 * g}, gray);
    builder.quad("sheet", {-0.5f, gap, 0.5f}, {1, 0, 0}, {0, 0, -1}, gray);
    if (strayAt > 0) builder.quad("stray", glm::vec3(strayAt), {1, 0, 0}, {0, 1, 0}, gray);
    builder.directionalLight({1, -0.25f, 0}, glm::vec3(1));
    builder.camera({0.5f, 1, 0}, {0.5f, 0, 0}, 40, {0, 0, -1});
    return std::make_shared<SceneState>(evaluate(builder.finish(), 0));
}

double directMean(const std::shared_ptr<SceneState>& state, const std::string& gbuffer = "gbuffer") {
    Chain chain(state, graphYaml({gbuffer + ", samples_per_pixel_edge: 4", "direct_shadow_rays"}), 32, 32, 1);
    return mean(chain.image("direct"));
}

double referenceMean(const std::shared_ptr<SceneState>& state) {
    Chain chain(state, graphYaml({"gbuffer", "path_trace, spp: 256, bounces: 0"}), 32, 32, 1);
    return mean(chain.image("final"));
}

TEST(SurfaceOffset, AStrayTriangleTakesNoShadowAway) {
    const double expected = directMean(sheetOverGround(2, 0.02f));
    for (const float stray : {1e3f, 1e5f, 1e7f}) {
        EXPECT_NEAR(directMean(sheetOverGround(2, 0.02f, stray)), expected, 1e-5 * expected) << stray;
        EXPECT_NEAR(referenceMean(sheetOverGround(2, 0.02f, stray)), expected, 2e-3 * expected) << stray;
    }
}

TEST(SurfaceOffset, LevelGroundIsAsCertainHoweverFarItReaches) {
    // Without the shadow it would be a fiftieth brighter
    const double expected = directMean(sheetOverGround(2, 0.02f));
    for (const float half : {1e3f, 1e5f}) {
        EXPECT_NEAR(directMean(sheetOverGround(half, 0.02f)), expected, 2e-3 * expected) << half;
        EXPECT_NEAR(referenceMean(sheetOverGround(half, 0.02f)), expected, 2e-3 * expected) << half;
    }
    EXPECT_NEAR(directMean(sheetOverGround(2, 0.02f), "gbuffer, method: raster"), expected, 2e-3 * expected);
    EXPECT_GT(directMean(sheetOverGround(2, 0)), 1.01 * expected);
}

TEST(SurfaceOffset, NoSurfaceHidesItself) {
    // Tilted walls of a closed room, at scales and places where coordinates are coarse
    for (const float scale : {1e-3f, 1.0f, 1e5f})
        for (const float away : {0.0f, 20.0f}) {
            SceneBuilder builder("octahedron");
            const uint32_t gray = builder.lambert("gray", glm::vec3(0.5f));
            const glm::vec3 center = scale * away * glm::vec3(1, -0.7f, 0.4f);
            builder.mesh(sphereMesh("room", center, scale, 1, gray, true, false));
            builder.place(0);
            builder.pointLight(center, glm::vec3(scale * scale));
            builder.camera(center + scale * glm::vec3(0, 0, 0.1f), center, 90);
            const auto state = std::make_shared<SceneState>(evaluate(builder.finish(), 0));
            Chain chain(state, graphYaml({"gbuffer", "direct_shadow_rays"}), 64, 64, 1);
            for (const float value : chain.image("direct").data)
                ASSERT_GT(value, 0.5f * 0.8f / 3.1416f * 0.8f) << scale << ' ' << away;
        }
}

}  // namespace
}  // namespace voxray::test
