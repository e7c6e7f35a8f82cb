// Voxels counted on the host and those that the device fills follow one rule: random boxes, and sheets on
// borders between voxels.
#include "passes/surfels/static_voxels.h"

#include <gtest/gtest.h>

#include <random>

#include "passes/common/voxels/triangle_voxels.h"
#include "tests/physics/voxels_read.h"

namespace voxray::test {
namespace {

using Random = std::mt19937;

float uniform(Random& random, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
}

/// A box of a size in which sheets lie on borders of the grid of `resolution`, and a few slivers.
State boxWithSheets(uint32_t seed, uint32_t resolution) {
    Random random(seed);
    const float scale = std::pow(10.0f, uniform(random, -3, 5));
    glm::vec3 half, origin;
    for (int axis = 0; axis < 3; ++axis) {
        half[axis] = scale * uniform(random, 0.2f, 1);
        origin[axis] = scale * (seed % 3 == 0 ? uniform(random, -20, 20) : 0);
    }
    SceneBuilder builder("box with sheets");
    const uint32_t gray = builder.lambert("gray", glm::vec3(0.5f));
    builder.room(origin - half, origin + half, {gray, gray, gray, gray, gray, gray});
    const gpu::VoxelGrid grid = makeVoxelGrid(origin - half, origin + half, resolution);
    for (int sheet = 0; sheet < 6; ++sheet) {
        const int axis = sheet % 3;
        glm::vec3 corner = origin - 0.9f * half, u(0.0f), v(0.0f);
        const auto border = float(1 + random() % std::max(grid.resolution[axis] - 1, 1u));
        corner[axis] = grid.origin[axis] + border * grid.voxelSize;
        u[(axis + 1) % 3] = 1.8f * half[(axis + 1) % 3];
        v[(axis + 2) % 3] = 1.8f * half[(axis + 2) % 3];
        builder.quad("sheet", corner, u, v, gray);
    }
    for (int sliver = 0; sliver < 8; ++sliver) {
        glm::vec3 at, way;
        for (int axis = 0; axis < 3; ++axis) {
            at[axis] = origin[axis] + half[axis] * uniform(random, -0.9f, 0);
            way[axis] = half[axis] * uniform(random, 0, 0.9f);
        }
        const glm::vec3 width = glm::vec3(way.y, way.z, way.x) * std::pow(10.0f, uniform(random, -7, -2));
        builder.quad("sliver", at, way, width, gray);
    }
    builder.camera(origin, origin + glm::vec3(0, 0, half.z), 60);
    return evaluated(builder);
}

TEST(StillVoxels, AreAllThatIsFilledWhereSheetsLieOnBorders) {
    for (uint32_t seed = 1; seed <= 24; ++seed) {
        const uint32_t resolution = 16 + 8 * (seed % 7);
        const auto state = boxWithSheets(seed, resolution);
        const char* method = seed % 2 == 0 ? "exact" : "dominant_axis";
        Chain chain(
            state,
            graphYaml({fmt::format("voxelize, visibility_rays: 0, resolution: {}, method: {}", resolution, method)}), 8,
            8);
        const Voxels voxels(chain);
        const uint32_t counted = countStaticVoxels(state->geometry, voxels.grid);
        EXPECT_GE(counted, voxels.count) << "seed " << seed << ", " << method;
        EXPECT_LE(counted, 1.25 * voxels.count) << "seed " << seed << ", " << method;
    }
}

TEST(StillVoxels, AreOnBothSidesOfAFloorAtHalfTheHeightOfABox) {
    SceneBuilder builder("two storeys");
    const uint32_t gray = builder.lambert("gray", glm::vec3(0.5f));
    builder.room({-10, -3, -10}, {10, 3, 10}, {gray, gray, gray, gray, gray, gray});
    builder.quad("floor", {-10, 0, 10}, {20, 0, 0}, {0, 0, -20}, gray);
    builder.camera({0, 1, 9}, {0, 1, 0}, 60);
    const auto state = evaluated(builder);
    Chain chain(state, graphYaml({"voxelize, resolution: 64"}), 8, 8);
    EXPECT_GE(countStaticVoxels(state->geometry, Voxels(chain).grid), Voxels(chain).count);
}

}  // namespace
}  // namespace voxray::test
