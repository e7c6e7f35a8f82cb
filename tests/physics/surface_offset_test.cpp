// Rays begin off surfaces by the error of the coordinates at hand: what lies far away changes nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

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
    return evaluated(builder);
}

double directMean(const std::shared_ptr<SceneState>& state, const std::string& gbuffer = "gbuffer") {
    Chain chain(state, graphYaml({gbuffer + ", samples_per_pixel_edge: 4", "direct_shadow_rays"}), 32, 32);
    return mean(chain.image("direct"));
}

double referenceMean(const std::shared_ptr<SceneState>& state) {
    Chain chain(state, graphYaml({"gbuffer", "path_trace, spp: 256, bounces: 0"}), 32, 32);
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
    // Without the shadow it would be a fiftieth brighter. Points on the ground are as uncertain as its
    // corners' floats are: the shadow's edge moves by that in the 0.73 m that the camera sees
    const double expected = directMean(sheetOverGround(2, 0.02f));
    for (const float half : {1e3f, 1e5f}) {
        const double tolerance = (2e-3 + 0.5 * std::numeric_limits<float>::epsilon() * half / 0.73) * expected;
        EXPECT_NEAR(directMean(sheetOverGround(half, 0.02f)), expected, tolerance) << half;
        EXPECT_NEAR(referenceMean(sheetOverGround(half, 0.02f)), expected, tolerance) << half;
    }
    EXPECT_NEAR(directMean(sheetOverGround(2, 0.02f), "gbuffer, method: raster"), expected, 2e-3 * expected);
    EXPECT_GT(directMean(sheetOverGround(2, 0)), 1.01 * expected);
}

TEST(SurfaceOffset, RaysEndShortOfLightsThatLieNearTheOrigin) {
    // Offsets are small there: where a ray from 2 m away meets the light is less certain
    SceneBuilder builder("glowing patch at the origin");
    const uint32_t gray = builder.lambert("gray", glm::vec3(0.5f)),
                   glow = builder.lambert("glow", glm::vec3(0), glm::vec3(1e4f));
    builder.quad("patch", {-1e-3f, 0, 1e-3f}, {2e-3f, 0, 0}, {0, 0, -2e-3f}, glow);
    builder.quad("ceiling", {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, gray);
    builder.camera({0, 0.5f, 0}, {0, 2, 0}, 60, {0, 0, -1});
    const auto state = evaluated(builder);
    Chain chain(state, graphYaml({"gbuffer", "direct_shadow_rays, light_samples: 16"}), 32, 32);
    // L A cos² / d², all of it seen
    const double expected = 0.5 / std::numbers::pi * 1e4 * 4e-6 / 4;
    EXPECT_NEAR(chain.image("direct").pixel(16, 16)[1], expected, 0.01 * expected);
}

TEST(SurfaceOffset, PointsOnTheEdgesOfARoomAreInIt) {
    // Pixels of a square image whose centers lie on the edges between the walls
    for (const uint32_t size : {32u, 64u, 96u}) {
        Chain chain("cornell", "{lights: point, boxes: false}", graphYaml({"gbuffer", "direct_shadow_rays"}), size,
                    size, 1);
        const ImageF image = chain.image("direct");
        const uint32_t border = size / 32;
        for (uint32_t y = border; y < size - border; ++y)
            for (uint32_t x = border; x < size - border; ++x)
                ASSERT_GT(image.pixel(x, y)[0] + image.pixel(x, y)[1], 0) << x << ' ' << y << " of " << size;
    }
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
            const auto state = evaluated(builder);
            Chain chain(state, graphYaml({"gbuffer", "direct_shadow_rays"}), 64, 64);
            for (const float value : chain.image("direct").data)
                ASSERT_GT(value, 0.5f * 0.8f / 3.1416f * 0.8f) << scale << ' ' << away;
        }
}

}  // namespace
}  // namespace voxray::test
