#include "passes/build_hybrid_leaves/leaf_counts.h"

#include <algorithm>

#include "passes/common/voxels/triangle_voxels.h"

namespace voxray {
namespace {

constexpr double kMargin = 1.0 / 4096;  // As in passes/common/triangle_walk/grid_triangle.glsl.

}  // namespace

std::vector<uint32_t> countLeafTriangles(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    std::vector<uint32_t> twice(geometry.triangles.size(), 0);
    for (const InstanceRange& run : movingRuns(geometry))
        std::fill_n(twice.begin() + run.firstTriangle, run.triangleCount, 1u);

    // The voxel of each pair, which has 10 bits along an axis
    std::vector<uint32_t> voxels;
    for (uint32_t t = 0; t < geometry.triangles.size(); ++t)
        visitVoxels(grid.resolution, cornersInVoxels(geometry, grid, t), kMargin, [&](glm::ivec3 v) {
            voxels.insert(voxels.end(), 1 + twice[t], uint32_t(v.x | v.y << 10 | v.z << 20));
        });
    std::ranges::sort(voxels);

    std::vector<uint32_t> counts;
    for (size_t i = 0; i < voxels.size(); ++i) {
        if (i == 0 || voxels[i] != voxels[i - 1]) counts.push_back(0);
        ++counts.back();
    }
    return counts;
}

}  // namespace voxray
