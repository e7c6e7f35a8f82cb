#include "trace/ray_query_tracer.h"

#include "shaders/trace/stream_count.h"
#include "vulkan/indirect.h"

namespace voxray {

RayQueryTracer::RayQueryTracer(Device& device, ShaderCompiler& compiler, const SceneState& state,
                               uint32_t trianglesPerChunk)
    : GpuTracer(device, state, trianglesPerChunk) {
    const std::shared_ptr<const ShaderModule> module = compiler.compile("shaders/trace/ray_query.comp");
    closestHit_ = makeComputeProgram(device, *module, {{"kOccluded", 0}});
    occluded_ = makeComputeProgram(device, *module, {{"kOccluded", 1}});
}

void RayQueryTracer::launch(CommandStream& stream, bool occluded, uint32_t count, const Bindings& call) {
    stream.dispatch(occluded ? occluded_ : closestHit_, count, call);
}

void RayQueryTracer::launchCounted(CommandStream& stream, bool occluded, const CountedRays& count,
                                   const Bindings& call) {
    dispatchIndirect(stream, occluded ? occluded_ : closestHit_, count.counts, count.index * sizeof(gpu::StreamCount),
                     call);
}

}  // namespace voxray
