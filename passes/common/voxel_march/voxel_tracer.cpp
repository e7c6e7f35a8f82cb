#include "passes/common/voxel_march/voxel_tracer.h"

#include <algorithm>

namespace voxray {
namespace {

constexpr uint32_t kRaysPerLaunch = 1u << 26;

}  // namespace

VoxelTracer::VoxelTracer(ProgramOwner& owner, VoxelTraversal traversal, float epsilon)
    : march_(owner, traversal, epsilon),
      closestHit_(owner, "voxel_tracer.comp", march_.defines()),
      occluded_(owner, "voxel_tracer.comp", march_.defines()) {}

void VoxelTracer::plan(MemoryPlan& plan, const SurfaceVoxels& voxels) {
    march_.plan(plan, voxels);
    closestHit_.specialize({{"kOccluded", 0}});
    occluded_.specialize({{"kOccluded", 1}});
}

void VoxelTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
                        Coherence) {
    for (uint32_t first = 0; first < count;) {
        const uint32_t end = first + std::min(kRaysPerLaunch, count - first);
        stream.dispatch(query == Query::Occluded ? occluded_ : closestHit_, end - first,
                        {march_,
                         {"rays", rays.address()},
                         {"results", results.address()},
                         {"grid", grid_},
                         {"firstRay", first},
                         {"endRay", end}});
        first = end;
    }
}

}  // namespace voxray
