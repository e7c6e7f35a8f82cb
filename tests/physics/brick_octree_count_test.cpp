// Nodes and bricks of the octree of Arnebäck 2017, counted by hand.
#include <gtest/gtest.h>

#include "tests/support/brick_octree_count.h"

namespace voxray::test {
namespace {

VoxelBits bitsOf(glm::uvec3 size, const std::vector<glm::ivec3>& voxels) {
    VoxelBits bits(size);
    for (const glm::ivec3 v : voxels) bits.mark(v);
    return bits;
}

void expectLevel(const BrickOctreeCount::Level& level, uint64_t opaque, uint64_t bricks, uint64_t nodes) {
    EXPECT_EQ(level.opaque, opaque);
    EXPECT_EQ(level.bricks, bricks);
    EXPECT_EQ(level.nodes, nodes);
}

TEST(BrickOctreeCount, OneVoxelHasTwentySixNeighborsOnEachLevel) {
    // Voxel 3 of 0 to 7, its parent 1 of 0 to 3, 0 of 0 and 1: there all eight nodes are neighbours.
    const BrickOctreeCount count = countBrickOctree(bitsOf(glm::uvec3(8), {{3, 3, 3}}));
    ASSERT_EQ(count.levels.size(), 4);
    expectLevel(count.levels[0], 1, 27, 8 * 27);
    expectLevel(count.levels[1], 1, 27, 8 * 8);
    expectLevel(count.levels[2], 1, 8, 8);
    expectLevel(count.levels[3], 1, 1, 1);
    EXPECT_EQ(count.bytes(), 44u * (8 * 27 + 8 * 8 + 8 + 1) + 108u * (27 + 27 + 8 + 1));

    const BrickOctreeCount alone = countBrickOctree(bitsOf(glm::uvec3(8), {{3, 3, 3}}), false);
    for (size_t level = 0; level < 3; ++level) expectLevel(alone.levels[level], 1, 1, 8);
    EXPECT_EQ(alone.bytes(), 44u * (3 * 8 + 1) + 108u * 4);
}

TEST(BrickOctreeCount, NeighborsEndWithTheBox) {
    // A corner has seven; a box of 5x3x2 has levels of 3x2x1, 2x1x1 and 1.
    const BrickOctreeCount count = countBrickOctree(bitsOf({5, 3, 2}, {{4, 2, 1}}));
    ASSERT_EQ(count.levels.size(), 4);
    expectLevel(count.levels[0], 1, 8, 8 * 4);
    expectLevel(count.levels[1], 1, 4, 8 * 2);
    expectLevel(count.levels[2], 1, 2, 8);
    expectLevel(count.levels[3], 1, 1, 1);
}

TEST(BrickOctreeCount, AFloorIsThreeLayersThick) {
    std::vector<glm::ivec3> floor;
    for (int z = 0; z < 64; ++z)
        for (int x = 0; x < 64; ++x) floor.push_back({x, 21, z});
    const BrickOctreeCount count = countBrickOctree(bitsOf(glm::uvec3(64), floor));
    for (size_t level = 0; level < 5; ++level) {  // At 21, 10, 5, 2, 1: never at the border of the box.
        const uint64_t area = (64 >> level) * (64 >> level);
        EXPECT_EQ(count.levels[level].opaque, area) << level;
        EXPECT_EQ(count.levels[level].bricks, 3 * area) << level;
    }
    expectLevel(count.levels[5], 4, 8, 8);  // At 0 of two.
}

/// Triangles in voxels of a grid of 8x8x8 at the origin.
struct Raster {
    explicit Raster(std::vector<glm::vec3> corners) {
        geometry.positions = std::move(corners);
        for (uint32_t i = 0; i < geometry.positions.size(); i += 3)
            geometry.triangles.push_back({i, i + 1, i + 2});
        grid.voxelSize = 1;
        grid.resolution = glm::uvec3(8);
    }
    uint32_t fragments(uint32_t samples) const { return rasterizedVoxels(geometry, grid, samples).count(); }

    Geometry geometry;
    gpu::VoxelGrid grid{};
};

TEST(RasterizedVoxels, HoldAFragmentForEachColumn) {
    // Floors across each axis, and one at 45°: a voxel a column, whatever the slope.
    for (int axis = 0; axis < 3; ++axis)
        for (const float slope : {0.0f, 1.0f}) {
            std::vector<glm::vec3> corners{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 0, 0}, {8, 8, 0}, {0, 8, 0}};
            for (glm::vec3& c : corners) {
                c.z = 2.3f * (1 - slope) + 0.999f * slope * c.x;
                c = glm::vec3(c[axis], c[(axis + 1) % 3], c[(axis + 2) % 3]);
            }
            EXPECT_EQ(Raster(corners).fragments(1), 64u) << axis << slope;
            EXPECT_EQ(Raster(corners).fragments(8), 64u) << axis << slope;
        }
}

TEST(RasterizedVoxels, EightSamplesFindWhatTheCenterMisses) {
    // A strip a tenth of a voxel wide off the centers: of the eight samples the one at x of -5/16 is in it.
    const Raster strip({{0.15f, 0, 2.5f},
                        {0.25f, 0, 2.5f},
                        {0.25f, 8, 2.5f},  //
                        {0.15f, 0, 2.5f},
                        {0.25f, 8, 2.5f},
                        {0.15f, 8, 2.5f}});
    EXPECT_EQ(strip.fragments(1), 0u);
    EXPECT_EQ(strip.fragments(8), 8u);
    EXPECT_EQ(metVoxels(strip.geometry, strip.grid).count(), 8u);
}

TEST(RasterizedVoxels, EndWithTheGrid) {
    const Raster outside(
        {{-4, -4, 3.5f}, {20, -4, 3.5f}, {-4, 20, 3.5f}, {0, 0, 8.5f}, {8, 0, 8.5f}, {0, 8, 8.5f}});
    EXPECT_EQ(outside.fragments(8), 64u);
    EXPECT_EQ(metVoxels(outside.geometry, outside.grid).count(), 64u);
}

}  // namespace
}  // namespace voxray::test
