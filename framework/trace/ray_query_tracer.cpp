#include "trace/ray_query_tracer.h"

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

}  // namespace voxray
