// A region of interest in a scene that is much larger: what is cut, and light in it against the path tracer.
#include "scene/region_split.h"

#include <gtest/gtest.h>

#include "passes/common/voxels/voxels.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// A room of 4 m, open to the front, on ground of 1 km, in the sun.
SceneState roomOnGround(const std::function<void(SceneBuilder&)>& addMore = [](SceneBuilder&) {}) {
    SceneBuilder builder("room on ground");
    const uint32_t gray = builder.lambert("gray", glm::vec3(0.6f)), ground = builder.lambert("ground", glm::vec3(0.3f));
    builder.quad("ground", {-500, 0, 500}, {1000, 0, 0}, {0, 0, -1000}, ground);
    builder.room({-2, 0.01f, -2}, {2, 3, 2}, {gray, gray, gray, gray, gray, SceneBuilder::none});
    builder.directionalLight({0.3f, -0.7f, -1}, glm::vec3(5));
    builder.camera({0, 1.5f, 3.5f}, {0, 1.4f, 0}, 60);
    addMore(builder);
    return evaluate(builder.finish(), 0);
}

double areaOf(const Geometry& g, const std::function<bool(uint32_t)>& isCounted) {
    double area = 0;
    for (uint32_t i = 0; i < g.triangles.size(); ++i) {
        const glm::uvec3 t = g.triangles[i];
        const glm::dvec3 a = g.positions[t.x], b = g.positions[t.y], c = g.positions[t.z];
        if (isCounted(i)) area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

constexpr Box kRoom{{-2.5f, 0, -2.5f}, {2.5f, 3.2f, 3}};

TEST(Region, CutsTrianglesAtItsBorderAndKeepsTheirSurface) {
    const SceneState whole = roomOnGround(), cut = splitAtRegion(whole, kRoom, 0);
    const auto all = [](uint32_t) { return true; };
    EXPECT_NEAR(areaOf(cut.geometry, all), areaOf(whole.geometry, all), 1e-6 * areaOf(whole.geometry, all));
    // 5 m by 5.5 m of ground, and the room
    const auto inside = [&](uint32_t t) { return isInRegion(cut.geometry, t); };
    EXPECT_NEAR(areaOf(cut.geometry, inside), 5 * 5.5 + 2 * 16 + 3 * 4 * 2.99, 1e-3);
    for (uint32_t t = 0; t < cut.geometry.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 p = cut.geometry.positions[cut.geometry.triangles[t][k]];
            const bool within = glm::all(glm::greaterThanEqual(p, kRoom.min - 1e-4f)) &&
                                glm::all(glm::lessThanEqual(p, kRoom.max + 1e-4f));
            EXPECT_TRUE(within || !inside(t));
        }
    EXPECT_EQ(splitAtRegion(whole, {{-1000, -1, -1000}, {1000, 9, 1000}}, 0).geometry.triangles.size(),
              whole.geometry.triangles.size());
}

TEST(Region, CutsWhatJointsBendWhereItIs) {
    const SceneState whole = evaluate(builtinScene("figure"), 0.5);
    constexpr Box kAboveTheHip{{-2, 1, -2}, {2, 2.5f, 2}};
    const SceneState cut = splitAtRegion(whole, kAboveTheHip, 0.5);
    EXPECT_GT(cut.geometry.triangles.size(), whole.geometry.triangles.size());
    const auto all = [](uint32_t) { return true; };
    EXPECT_NEAR(areaOf(cut.geometry, all), areaOf(whole.geometry, all), 1e-6 * areaOf(whole.geometry, all));
    EXPECT_EQ(cut.geometry.boundsMin, whole.geometry.boundsMin);
    EXPECT_EQ(cut.geometry.boundsMax, whole.geometry.boundsMax);
}

TEST(Region, HoldsTrianglesThatLieInItsBorder) {
    // A third of this, added up three times, is a larger float
    const float wall = 0.43491772f;
    ASSERT_GT(wall / 3.0f + wall / 3.0f + wall / 3.0f, wall);
    SceneBuilder builder("wall");
    builder.quad("wall", {wall, 0, 0}, {0, 1, 0}, {0, 0, 1}, builder.lambert("gray", glm::vec3(0.5f)));
    builder.quad("far", {-9, 0, 0}, {0, 1, 0}, {0, 0, 1}, builder.lambert("white", glm::vec3(0.8f)));
    builder.directionalLight({1, 0, 0}, glm::vec3(1));
    builder.camera({0, 0.5f, 0.5f}, {wall, 0.5f, 0.5f}, 60);
    const SceneState cut = splitAtRegion(evaluate(builder.finish(), 0), {glm::vec3(0), {wall, 1, 1}}, 0);
    std::vector<bool> inside;
    for (uint32_t t = 0; t < cut.geometry.triangles.size(); ++t) inside.push_back(isInRegion(cut.geometry, t));
    EXPECT_EQ(inside, (std::vector<bool>{true, true, false, false}));
}

/// Expects the mean indirect light of gather rays in kRoom to be the reference's. @return the voxels' edge,
/// m.
float expectTheReference(const SceneState& whole) {
    const auto state = std::make_shared<SceneState>(splitAtRegion(whole, kRoom, 0));
    Chain chain(state,
                graphYaml({"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: 64",
                           "inject_light_rays, rays_per_light: 524288, bounces: 6",
                           "trace_gather_rays, rays_per_block: 64", "gather_rays"}),
                32, 32);
    // 524288 paths and as many light rays: noise of about half a percent of the mean
    const double expected = mean(pathTraced(state, 512, 7)), found = mean(chain.image("indirect"));
    EXPECT_NEAR(found, expected, 0.03 * expected);
    return chain.get<SurfaceVoxels>("voxels").grid.voxelSize;
}

TEST(Region, GatherRaysInARoomOnALargeGroundMatchTheReference) {
    // 64 voxels along the region's longest side
    EXPECT_NEAR(expectTheReference(roomOnGround()), 5.5f / 63.75f, 1e-4f);
}

TEST(Region, LightRaysHitSurfacesHoweverFarOthersLie) {
    // Out there floats are half a metre and more apart
    expectTheReference(roomOnGround([](SceneBuilder& builder) {
        builder.quad("stray", {1e7f, 0, 0}, {1, 0, 0}, {0, 1, 0}, builder.lambert("stray", glm::vec3(0.5f)));
    }));
}

TEST(Region, SurfacesFarAwayOccludeLightRays) {
    // A screen 5 km towards the sun, whose shadow's edge halves the room
    expectTheReference(roomOnGround([](SceneBuilder& builder) {
        const glm::vec3 towardsSun = glm::normalize(glm::vec3(-0.3f, 0.7f, 1)), center = 5000.0f * towardsSun;
        builder.quad("screen", center + glm::vec3(0, -50, 0), {100, 0, 0}, {0, 100, 0},
                     builder.lambert("screen", glm::vec3(0.5f)));
    }));
}

}  // namespace
}  // namespace voxray::test
