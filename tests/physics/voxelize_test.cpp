// Voxelization against what geometry says: areas, coverage, averages, and that no surface is missed.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/voxels_read.h"

namespace voxray::test {
namespace {

TEST(Voxelize, SumsToTheSurfaceArea) {
    // A sphere has every orientation: the clipped fragments must add up to its area all the same.
    Chain chain("furnace", "{shape: sphere, albedo: 0.5}", graphYaml({"voxelize, resolution: 48"}));
    const Voxels voxels(chain);
    double area = 0;
    glm::dvec3 unoccluded(0.0);
    for (const gpu::VoxelMaterial& m : voxels.materials) {
        area += m.area;
        unoccluded += glm::dvec3(m.unoccludedPositive + m.unoccludedNegative);
    }
    const double face = double(voxels.grid.voxelSize) * voxels.grid.voxelSize;
    const double expected = surfaceArea(chain.state().geometry);
    EXPECT_NEAR(area * face / expected, 1.0, 0.005);
    // Nothing is near either side of a large sphere: both are visible.
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(unoccluded[axis] * face / (2 * expected / 3), 1.0, 0.01);
}

TEST(Voxelize, InnerSidesOfThinWallsAreNotVisible) {
    // Cornell's boxes are closed shells; at 4 voxels along the room each side faces another within a voxel,
    // so that the shells' inner sides drop out. At 64 voxels they are wider than a voxel and count.
    const auto unoccludedFraction = [](uint32_t resolution) {
        Chain chain("cornell", "{}", graphYaml({"voxelize, resolution: " + std::to_string(resolution)}));
        const Voxels voxels(chain);
        double area = 0, unoccluded = 0;
        for (const gpu::VoxelMaterial& m : voxels.materials) {
            area += 2 * m.area;
            for (int axis = 0; axis < 3; ++axis) unoccluded += m.unoccludedPositive[axis] + m.unoccludedNegative[axis];
        }
        return unoccluded / area;
    };
    EXPECT_GT(unoccludedFraction(64), 0.95);
    EXPECT_LT(unoccludedFraction(3), unoccludedFraction(64) - 0.05);
}

TEST(Voxelize, RanksCountOccupiedVoxels) {
    Chain chain("cornell", "{}", graphYaml({"voxelize, resolution: 40"}));
    const Voxels voxels(chain);
    uint32_t before = 0;
    for (size_t word = 0; word < voxels.occupancy.size(); ++word) {
        ASSERT_EQ(voxels.rank[word], before) << "word " << word;
        before += uint32_t(std::popcount(voxels.occupancy[word]));
    }
    EXPECT_EQ(before, voxels.count);
    EXPECT_EQ(voxels.materials.size(), voxels.count);
}

TEST(Voxelize, AveragesMaterials) {
    Chain chain("furnace", "{shape: box, albedo: 0.25, emission: 3}", graphYaml({"voxelize, resolution: 16"}));
    const Voxels voxels(chain);
    for (const gpu::VoxelMaterial& m : voxels.materials) {
        ASSERT_NEAR(m.albedo.x, 0.25, 1e-3);
        ASSERT_NEAR(m.emission.y, 3.0, 1e-2);
        ASSERT_LE(glm::length(m.normal), 1.001f);
        ASSERT_GT(m.opacity, 0.0f);
        ASSERT_LE(m.opacity, 1.0f);
    }
}

TEST(Voxelize, IsDeterministic) {
    const auto run = [] {
        Chain chain("cornell", "{}", graphYaml({"voxelize"}));
        return Voxels(chain).materials;
    };
    EXPECT_TRUE(sameBits(run(), run()));
}

}  // namespace
}  // namespace voxray::test
