#include "passes/common/voxels/voxel_count.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "passes/common/voxels/triangle_voxels.h"
#include "passes/common/voxels/voxel_bits.h"
#include "scene/region_split.h"

namespace voxray {
namespace {

/// The most voxels that a window of `side` voxels holds.
uint32_t fullestWindow(const VoxelBits& bits, uint32_t side) {
    // Voxels by block
    const int block = int(side) / 4;
    const glm::ivec3 blocks = (glm::ivec3(bits.size()) + block - 1) / block;
    std::vector<uint32_t> sums(size_t(blocks.x) * size_t(blocks.y) * size_t(blocks.z), 0);
    const auto at = [&](glm::ivec3 b) {
        return (size_t(b.z) * size_t(blocks.y) + size_t(b.y)) * size_t(blocks.x) + size_t(b.x);
    };
    bits.forEach([&](glm::ivec3 v) { ++sums[at(v / block)]; });

    // Sums over the blocks that a window meets, along one axis after the other: all up to four, else five
    for (int axis = 0; axis < 3; ++axis) {
        const int reach = blocks[axis] <= 4 ? blocks[axis] : 5;
        for (glm::ivec3 b(0); b.z < blocks.z; ++b.z)
            for (b.y = 0; b.y < blocks.y; ++b.y)
                for (b.x = 0; b.x < blocks.x; ++b.x) {
                    glm::ivec3 next = b;
                    for (++next[axis]; next[axis] < std::min(b[axis] + reach, blocks[axis]); ++next[axis])
                        sums[at(b)] += sums[at(next)];
                }
    }
    return *std::ranges::max_element(sums);
}

/// What `measure` finds at each level of the voxels that the triangles chosen by `selected` pass through.
template <typename Measure>
std::vector<uint32_t> count(const Geometry& geometry, const gpu::VoxelGrid& grid,
                            const std::vector<bool>& selected, const Measure& measure) {
    VoxelBits bits(grid.resolution);
    parallelRanges(geometry.triangles.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) {
            if (!selected[t] || !isInRegion(geometry, uint32_t(t))) continue;
            const std::array<glm::dvec3, 3> corners = cornersInVoxels(geometry, grid, uint32_t(t));
            visitVoxels(bits.size(), corners, [&](glm::ivec3 voxel) { bits.mark(voxel); });
        }
    });

    std::vector<uint32_t> counts{measure(bits)};
    while (bits.size() != glm::uvec3(1)) {
        bits = bits.coarser();
        counts.push_back(measure(bits));
    }
    return counts;
}

/// Whether each triangle stays where it is.
std::vector<bool> stillTriangles(const Geometry& geometry) {
    std::vector<bool> still(geometry.triangles.size(), true);
    for (const InstanceRange& run : movingRuns(geometry))
        std::fill_n(still.begin() + run.firstTriangle, run.triangleCount, false);
    return still;
}

/// Of what stays, and twice of what moves.
template <typename Measure>
std::vector<uint32_t> countStillAndMoving(const Geometry& geometry, const gpu::VoxelGrid& grid,
                                          const Measure& measure) {
    std::vector<bool> still = stillTriangles(geometry);
    std::vector<uint32_t> counts = count(geometry, grid, still, measure);
    if (movingRuns(geometry).empty()) return counts;

    still.flip();
    const std::vector<uint32_t> moving = count(geometry, grid, still, measure);
    for (size_t level = 0; level < counts.size(); ++level) counts[level] += 2 * moving[level];
    return counts;
}

}  // namespace

std::vector<uint32_t> countSurfaceVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    return countStillAndMoving(geometry, grid, [](const VoxelBits& bits) { return bits.count(); });
}

std::vector<uint32_t> countWindowVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t side) {
    return countStillAndMoving(geometry, grid,
                               [&](const VoxelBits& bits) { return fullestWindow(bits, side); });
}

uint32_t countStillVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    return count(geometry, grid, stillTriangles(geometry), [](const VoxelBits& bits) { return bits.count(); })
        .front();
}

}  // namespace voxray
