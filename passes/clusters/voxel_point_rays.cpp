#include "passes/clusters/voxel_point_rays.h"

#include <algorithm>

#include "trace/ray.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds rays and answers to 36 MiB.

}  // namespace

void VoxelPointRays::plan(PassPlan& plan) {
    plan.scratchBuffer(rays_, "rays from points round voxels", kBatchRays * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility of points", kBatchRays * sizeof(uint32_t));
}

void VoxelPointRays::trace(PassContext& context, uint32_t voxels, const std::function<void(const Batch&)>& generate,
                           const std::function<void(const Batch&)>& use) const {
    const uint32_t perBatch = kBatchRays / pointsPerVoxel_;
    for (uint32_t first = 0; first < voxels; first += perBatch) {
        const Batch batch{first, std::min(perBatch, voxels - first)};
        generate(batch);
        context.tracer.occluded(context.stream, rays_, occluded_, batch.voxels * pointsPerVoxel_);
        use(batch);
    }
}

}  // namespace voxray
