#pragma once

#include "trace/gpu_tracer.h"

namespace voxray {

/// Traces streams by ray queries in a compute shader (VK_KHR_ray_query).
class RayQueryTracer final : public GpuTracer {
 public:
    RayQueryTracer(Device& device, ShaderCompiler& compiler, const SceneState& state, uint32_t trianglesPerChunk);
    std::string_view name() const override { return "ray_query"; }

 private:
    void launch(CommandStream& stream, bool occluded, uint32_t count, const Bindings& call) override;
    void launchCounted(CommandStream& stream, bool occluded, const CountedRays& count, const Bindings& call) override;

    Program closestHit_;
    Program occluded_;
};

}  // namespace voxray
