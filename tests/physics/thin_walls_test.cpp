// Two sides of a wall within one voxel: what each layout tells of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "scene/shapes.h"
#include "tests/gpu/radiance_samples.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/radiance_layouts.h"

namespace voxray::test {
namespace {

/// A wall of 2 m x 2 m x 2 cm across x, red towards -x and green towards +x, a light on either side: the case
/// of Arnebäck 2017, figure 15.
State redAndGreenWall() {
    SceneBuilder b("red_green_wall");
    const uint32_t red = b.lambert("red", {0.8f, 0.0f, 0.0f}), green = b.lambert("green", {0.0f, 0.8f, 0.0f}),
                   black = b.lambert("black", glm::vec3(0.0f));
    b.quad("red", {-0.01f, -1, -1}, {0, 0, 2}, {0, 2, 0}, red);
    b.quad("green", {0.01f, -1, -1}, {0, 2, 0}, {0, 0, 2}, green);
    // Two specks that make the grid a cube of 2.2 m.
    for (const float x : {-1.1f, 1.09f}) b.box("speck", {x, -1.1f, 0}, glm::vec3(0.01f), 0, black);
    for (const float x : {-1.0f, 1.0f}) b.pointLight({x, 0, 0}, glm::vec3(1.0f));
    b.camera({-1, 0, 0}, {0, 0, 0}, 60);
    return evaluated(b);
}

Chain wall(const std::string& voxelize, const std::string& filter) {
    return Chain(redAndGreenWall(),
                 graphYaml({"voxelize, " + voxelize, "inject_light_rays, bounces: 0", "filter_voxels, " + filter}), 16,
                 16);
}

/// What a ray along ±x (`towards`) meets in the wall, in steps of half a footprint of so many voxels.
glm::vec3 seen(const Chain& chain, float towards, float footprint) {
    const float width = footprint * radiance(chain).grid.voxelSize;
    std::vector<RadianceQuery> queries;
    for (float x = -3 * width; x <= 3 * width; x += 0.5f * width)
        queries.push_back({{x, 0.1f, 0.1f}, width, {towards, 0, 0}});
    glm::vec3 sum(0.0f);
    for (const glm::vec4& met : sampleRadiance(chain, queries)) sum += 0.5f * glm::vec3(met);
    return sum;
}

TEST(ThinWalls, SidesOfAWallInOneVoxelKeepTheirColours) {
    // Voxels of 7 cm and up to 16 times that.
    for (const auto& [filter, followsCamera] : kRadianceLayouts) {
        const Chain chain = wall("resolution: 32", "layout: " + filter);
        for (const float footprint : {1.0f, 2.0f, 4.0f, 16.0f}) {
            const glm::vec3 red = seen(chain, 1, footprint), green = seen(chain, -1, footprint);
            EXPECT_GT(red.r, 0.05f) << filter << ", " << footprint;
            EXPECT_NEAR(green.g, red.r, 0.03f * red.r) << filter << ", " << footprint;
            EXPECT_EQ(red.g, 0.0f) << filter << ", " << footprint;
            EXPECT_EQ(green.r, 0.0f) << filter << ", " << footprint;
        }
    }
}

TEST(ThinWalls, OneDirectionMakesThemBrown) {
    // What six directions are for: with one, both sides look alike.
    for (const auto& [filter, followsCamera] : kRadianceLayouts) {
        const Chain chain = wall("resolution: 32, directions: 1", "layout: " + filter);
        const glm::vec3 red = seen(chain, 1, 2.0f), green = seen(chain, -1, 2.0f);
        EXPECT_NEAR(red.g, red.r, 0.03f * red.r) << filter;
        EXPECT_NEAR(green.r, red.r, 0.03f * red.r) << filter;
    }
}

/// Indirect light by gather rays in a dark room next to a lit one, 5 cm apart, relative to that in the lit
/// one.
double leakOfGatherRays(const std::string& inject) {
    const auto seen = [&](const std::string& view) {
        return meanIndirect("thin_wall", "{thickness: 0.05, view: " + view + "}",
                            graphYaml({"gbuffer", "voxelize, resolution: 64", "place_surfels", inject + ", bounces: 3",
                                       "trace_gather_rays, rays_per_block: 64", "gather_rays"}));
    };
    return seen("dark") / seen("lit");
}

TEST(ThinWalls, RaysLeakWhereVoxelsAreShared) {
    // Light rays never enter the dark room. Voxel rays light a voxel's face by points all over it: where
    // floor and ceiling of both rooms share voxels, by those of the lit room, too.
    EXPECT_EQ(leakOfGatherRays("inject_light_rays, rays_per_light: 262144"), 0.0);
    EXPECT_LT(leakOfGatherRays("inject_voxel_rays, paths_per_point: 16"), 0.005);
}

/// Area that light can reach, m², by voxel and the six faces: of so many plates in one place, 2 m x 2 m, tilted by
/// `rise`, and of a plate in front of a part of them, in the same plane.
std::vector<double> visibleAreas(int copies, bool hasPart, float rise, int visibilityRays) {
    SceneBuilder b("plates");
    const uint32_t white = b.lambert("white", glm::vec3(0.8f));
    const glm::vec3 corner(-1, 0.01f, -1), along(0, rise, 2), across(2, 0.5f * rise, 0);
    for (int i = 0; i < copies; ++i) b.quad("plate", corner, along, across, white);
    if (hasPart) b.quad("part", corner + 0.3f * along + 0.2f * across, 0.5f * along, 0.5f * across, white);
    for (const float y : {-1.3f, 1.29f}) b.box("speck", {0, y, 0}, glm::vec3(0.01f), 0, white);
    b.pointLight({0, 1, 0}, glm::vec3(1.0f));
    b.camera({0, 1, 0}, {0, 0, 0.1f}, 60);
    Chain chain(evaluated(b), graphYaml({fmt::format("voxelize, resolution: 16, visibility_rays: {}", visibilityRays)}),
                16, 16);
    const Voxels voxels(chain);
    const double face = double(voxels.grid.voxelSize) * voxels.grid.voxelSize;
    std::vector<double> areas;
    for (const gpu::VoxelMaterial& m : voxels.materials)
        for (int axis = 0; axis < 3; ++axis) {
            areas.push_back(m.unoccludedPositive[axis] * face);
            areas.push_back(m.unoccludedNegative[axis] * face);
        }
    return areas;
}

double visibleArea(int copies, bool hasPart, float rise) {
    const std::vector<double> areas = visibleAreas(copies, hasPart, rise, 64);
    return std::accumulate(areas.begin(), areas.end(), 0.0);
}

TEST(ThinWalls, SurfacesThatCoincideHaveTheAreaOfOne) {
    for (const float rise : {0.0f, 0.37f}) {
        const double one = visibleArea(1, false, rise);
        EXPECT_NEAR(one / (2 * 2 * glm::length(glm::cross(glm::vec3(0, rise, 2), glm::vec3(1, 0.25f * rise, 0)))), 1.0,
                    0.01)
            << rise;
        EXPECT_NEAR(visibleArea(2, false, rise) / one, 1.0, 0.01) << rise;
        EXPECT_NEAR(visibleArea(3, false, rise) / one, 1.0, 0.01) << rise;
        EXPECT_NEAR(visibleArea(1, true, rise) / one, 1.0, 0.01) << rise;
    }
}

TEST(ThinWalls, CopiesOfASurfaceHaveItsAreaInEachVoxel) {
    const std::vector<double> one = visibleAreas(1, false, 0.37f, 8), two = visibleAreas(2, false, 0.37f, 8);
    ASSERT_EQ(two.size(), one.size());
    double difference2 = 0, sum2 = 0;
    for (size_t i = 0; i < one.size(); ++i) {
        difference2 += (two[i] - one[i]) * (two[i] - one[i]);
        sum2 += one[i] * one[i];
    }
    // The numbers of copies' probes may differ by one a triangle. With probes of their own it is 0.14.
    EXPECT_LT(std::sqrt(difference2 / sum2), 0.05);
}

}  // namespace
}  // namespace voxray::test
