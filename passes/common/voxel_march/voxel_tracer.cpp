#include "passes/common/voxel_march/voxel_tracer.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

constexpr uint32_t kRaysPerLaunch = 1u << 26;

struct MarchPush {
    VkDeviceAddress rays, hits;
    gpu::VoxelGrid grid;
    uint32_t firstRay, endRay;
};

}  // namespace

void VoxelTracer::prepare(Device& device, const ShaderCompiler& compiler) {
    march_.prepare(device, compiler);
    const ShaderModule module =
        compiler.compile("passes/common/voxel_march/voxel_tracer.comp", march_.defines());
    closestHit_ = makeComputeProgram(device, module, {{"kOccluded", 0}});
    occluded_ = makeComputeProgram(device, module, {{"kOccluded", 1}});
}

void VoxelTracer::trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results,
                        uint32_t count, Coherence) {
    for (uint32_t first = 0; first < count;) {
        const uint32_t end = first + std::min(kRaysPerLaunch, count - first);
        stream.dispatch(query == Query::Occluded ? occluded_ : closestHit_, march_.bindings(),
                        MarchPush{rays.address(), results.address(), grid_, first, end},
                        linearGroups(end - first));
        first = end;
    }
}

}  // namespace voxray
