#include "tests/support/brick_octree_count.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "passes/common/voxels/triangle_voxels.h"

namespace voxray {
namespace {

/// Samples of a pixel, in sixteenths of its width from its center.
constexpr std::array<glm::ivec2, 1> kCenter{{{0, 0}}};
constexpr std::array<glm::ivec2, 8> kEight{{{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}}};

/// Visits the voxels of a triangle's fragments, inside of the grid or not.
template <typename Visit>
void visitFragments(const std::array<glm::dvec3, 3>& corners, glm::ivec3 resolution,
                    std::span<const glm::ivec2> samples, const Visit& visit) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::dvec3 size = glm::abs(normal);
    const int w = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
    const int u = (w + 1) % 3, v = (w + 2) % 3;
    if (size[w] <= 0) return;
    const double sign = normal[w] > 0 ? 1.0 : -1.0;
    const auto isCovered = [&](double x, double y) {
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec3 from = corners[i], along = corners[(i + 1) % 3] - from;
            if (sign * (along[u] * (y - from[v]) - along[v] * (x - from[u])) < 0) return false;
        }
        return true;
    };

    const glm::dvec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::dvec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const glm::dvec3 voxels(resolution);
    const glm::ivec3 first(glm::clamp(glm::floor(low), glm::dvec3(0), voxels));
    const glm::ivec3 last(glm::clamp(glm::floor(high), glm::dvec3(-1), voxels - 1.0));
    for (int y = first[v]; y <= last[v]; ++y)
        for (int x = first[u]; x <= last[u]; ++x) {
            const glm::dvec2 center(x + 0.5, y + 0.5);
            if (std::ranges::none_of(
                    samples, [&](glm::ivec2 s) { return isCovered(center.x + s.x / 16.0, center.y + s.y / 16.0); }))
                continue;
            const double depth =
                corners[0][w] -
                (normal[u] * (center.x - corners[0][u]) + normal[v] * (center.y - corners[0][v])) / normal[w];
            glm::ivec3 voxel;
            voxel[u] = x;
            voxel[v] = y;
            voxel[w] = int(std::floor(depth));
            visit(voxel);
        }
}

/// The voxels that `visitOf(corners, mark)` finds of each triangle.
template <typename VisitOf>
VoxelBits voxelsOf(const Geometry& geometry, const gpu::VoxelGrid& grid, const VisitOf& visitOf) {
    VoxelBits bits(grid.resolution);
    parallelRanges(geometry.triangles.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t)
            visitOf(cornersInVoxels(geometry, grid, uint32_t(t)), [&](glm::ivec3 voxel) {
                if (bits.isInside(voxel)) bits.mark(voxel);
            });
    });
    return bits;
}

/// Calls visit(voxel) for all marked voxels.
template <typename Visit>
void forEach(const VoxelBits& bits, const Visit& visit) {
    for (glm::ivec3 v(0); v.z < int(bits.size().z); ++v.z)
        for (v.y = 0; v.y < int(bits.size().y); ++v.y)
            for (v.x = 0; v.x < int(bits.size().x); ++v.x)
                if (bits[v]) visit(v);
}

/// The voxels of the next coarser level with a marked one in them.
VoxelBits coarser(const VoxelBits& bits) {
    VoxelBits result((bits.size() + 1u) / 2u);
    forEach(bits, [&](glm::ivec3 v) { result.mark(v / 2); });
    return result;
}

/// The marked voxels and their 26 neighbors in the box.
VoxelBits withNeighbors(const VoxelBits& bits) {
    VoxelBits result(bits.size());
    forEach(bits, [&](glm::ivec3 v) {
        for (int i = 0; i < 27; ++i) {
            const glm::ivec3 neighbor = v + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
            if (result.isInside(neighbor)) result.mark(neighbor);
        }
    });
    return result;
}

std::span<const glm::ivec2> samplePoints(uint32_t samples) {
    return samples == 1 ? std::span<const glm::ivec2>(kCenter) : kEight;
}

}  // namespace

uint64_t BrickOctreeCount::nodes() const {
    uint64_t sum = 0;
    for (const Level& level : levels) sum += level.nodes;
    return sum;
}

uint64_t BrickOctreeCount::bricks() const {
    uint64_t sum = 0;
    for (const Level& level : levels) sum += level.bricks;
    return sum;
}

BrickOctreeCount countBrickOctree(VoxelBits voxels, bool neighbors) {
    BrickOctreeCount count;
    while (true) {
        const uint32_t bricks = (neighbors ? withNeighbors(voxels) : voxels).count();
        count.levels.push_back({voxels.count(), bricks, 0});
        if (voxels.size() == glm::uvec3(1)) break;
        voxels = coarser(voxels);
    }
    for (size_t level = 0; level + 1 < count.levels.size(); ++level)
        count.levels[level].nodes = 8 * count.levels[level + 1].bricks;
    count.levels.back().nodes = 1;
    return count;
}

VoxelBits rasterizedVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t samples) {
    return voxelsOf(geometry, grid, [&](const std::array<glm::dvec3, 3>& corners, const auto& mark) {
        visitFragments(corners, glm::ivec3(grid.resolution), samplePoints(samples), mark);
    });
}

VoxelBits metVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    return voxelsOf(geometry, grid, [&](const std::array<glm::dvec3, 3>& corners, const auto& mark) {
        visitVoxels(grid.resolution, corners, mark);
    });
}

}  // namespace voxray
