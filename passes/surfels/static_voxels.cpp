#include "passes/surfels/static_voxels.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "passes/common/voxels/triangle_voxels.h"
#include "passes/common/voxels/voxel_bits.h"
#include "scene/region_split.h"

namespace voxray {

uint32_t countStaticVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    std::vector<bool> isStatic(geometry.triangles.size(), true);
    for (const InstanceRange& range : movingInstanceRanges(geometry))
        std::fill_n(isStatic.begin() + range.firstTriangle, range.triangleCount, false);

    VoxelBits bits(grid.resolution);
    parallelRanges(geometry.triangles.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) {
            if (!isStatic[t] || !isInRegion(geometry, uint32_t(t))) continue;
            visitVoxels(bits.size(), cornersInVoxels(geometry, grid, uint32_t(t)),
                        [&](glm::ivec3 voxel) { bits.mark(voxel); });
        }
    });
    return bits.count();
}

}  // namespace voxray
