#include "passes/hybrid_leaves/hybrid_tracer.h"

#include <algorithm>

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint32_t kRaysPerLaunch = 1u << 26;

}  // namespace

HybridTracer::HybridTracer(ProgramOwner& owner, HybridTraversal traversal)
    : march_(owner, traversal == HybridTraversal::Hierarchical ? VoxelTraversal::Bricks : VoxelTraversal::SvoVoxels),
      closestHit_(owner, "hybrid_tracer.comp", march_.defines()),
      occluded_(owner, "hybrid_tracer.comp", march_.defines()) {}

void HybridTracer::plan(MemoryPlan& plan, const SurfaceVoxels& voxels) {
    march_.plan(plan, voxels);
    plan.buffer(testCounts_, "tests of triangles", sizeof(uint64_t));
    closestHit_.specialize({{"kOccluded", 0}});
    occluded_.specialize({{"kOccluded", 1}});
}

void HybridTracer::begin(CommandStream& stream, const GpuScene& scene, const SurfaceVoxels& voxels,
                         const HybridLeaves& leaves, float maxWidth) {
    march_.begin(stream, leaves.voxels(voxels));
    stream.fill(testCounts_, 0);
    scene_ = &scene;
    leaves_ = &leaves;
    grid_ = voxels.grid;
    maxWidth_ = maxWidth;
}

void HybridTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
                         Coherence) {
    if (starts_ && starts_->bytes() < count * sizeof(gpu::RayStart))
        throw Error("hybrid tracer: a buffer of the starts of {} rays is too small", count);
    for (uint32_t first = 0; first < count;) {
        const uint32_t end = first + std::min(kRaysPerLaunch, count - first);
        stream.dispatch(query == Query::Occluded ? occluded_ : closestHit_, end - first,
                        {*scene_,
                         march_,
                         *leaves_,
                         {"hybridTestCounts", testCounts_},
                         {"rays", rays.address()},
                         {"starts", starts_ ? starts_->address() : 0},
                         {"results", results.address()},
                         {"grid", grid_},
                         {"maxWidth", maxWidth_},
                         {"firstRay", first},
                         {"endRay", end}});
        first = end;
    }
}

}  // namespace voxray
