#include "passes/common/hybrid_leaves/hybrid_tracer.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

constexpr uint32_t kRaysPerLaunch = 1u << 26;

struct HybridPush {
    VkDeviceAddress rays, starts, hits;
    gpu::VoxelGrid grid;
    float widest;
    uint32_t firstRay, endRay;
};

}  // namespace

HybridTracer::HybridTracer(HybridWalk walk)
    : march_(walk == HybridWalk::Hierarchical ? VoxelWalk::Bricks : VoxelWalk::SvoVoxels) {}

void HybridTracer::plan(MemoryPlan& plan, const SurfaceVoxels& voxels) {
    march_.plan(plan, voxels);
    plan.buffer(testCounts_, "tests of triangles", sizeof(uint64_t));
}

void HybridTracer::prepare(Device& device, const ShaderCompiler& compiler) {
    march_.prepare(device, compiler);
    const ShaderModule module =
        compiler.compile("passes/common/hybrid_leaves/hybrid_tracer.comp", march_.defines());
    closestHit_ = makeComputeProgram(device, module, {{"kOccluded", 0}});
    occluded_ = makeComputeProgram(device, module, {{"kOccluded", 1}});
}

void HybridTracer::begin(CommandStream& stream, const GpuScene& scene, const SurfaceVoxels& voxels,
                         const HybridLeaves& leaves, float widest) {
    march_.begin(stream, leaves.voxels(voxels));
    stream.fill(testCounts_, 0);
    scene_ = &scene;
    leaves_ = &leaves;
    grid_ = voxels.grid;
    widest_ = widest;
}

void HybridTracer::closestFrom(CommandStream& stream, const Buffer& rays, const Buffer& starts,
                               const Buffer& hits, uint32_t count) {
    if (rays.bytes() < count * sizeof(Ray) || starts.bytes() < count * sizeof(gpu::RayStart) ||
        hits.bytes() < count * sizeof(Hit))
        throw Error("hybrid tracer: buffers of {} rays are too small", count);
    dispatch(stream, closestHit_, rays.address(), starts.address(), hits.address(), count);
}

void HybridTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results,
                         uint32_t count, Coherence) {
    if (starts_ && starts_->bytes() < count * sizeof(gpu::RayStart))
        throw Error("hybrid tracer: a buffer of the starts of {} rays is too small", count);
    dispatch(stream, query == Query::Occluded ? occluded_ : closestHit_, rays.address(),
             starts_ ? starts_->address() : 0, results.address(), count);
}

void HybridTracer::dispatch(CommandStream& stream, const Program& program, VkDeviceAddress rays,
                            VkDeviceAddress starts, VkDeviceAddress results, uint32_t count) {
    std::vector<Binding> bindings = scene_->bindings({{"hybridTestCounts", testCounts_}});
    for (const std::vector<Binding>& more : {march_.bindings(), leaves_->bindings()})
        bindings.insert(bindings.end(), more.begin(), more.end());
    for (uint32_t first = 0; first < count;) {
        const uint32_t end = first + std::min(kRaysPerLaunch, count - first);
        stream.dispatch(program, bindings, HybridPush{rays, starts, results, grid_, widest_, first, end},
                        linearGroups(end - first));
        first = end;
    }
}

}  // namespace voxray
