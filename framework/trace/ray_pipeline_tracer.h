#pragma once

#include "trace/gpu_tracer.h"

namespace voxray {

/// Traces streams by ray-tracing pipelines (VK_KHR_ray_tracing_pipeline).
class RayPipelineTracer final : public GpuTracer {
 public:
    RayPipelineTracer(Device& device, ShaderCompiler& compiler, const SceneState& state, uint32_t trianglesPerChunk);
    std::string_view name() const override { return "ray_pipeline"; }

 private:
    /// A pipeline and its shader binding table, with one record each for ray generation, miss and hit group.
    struct Pipeline {
        Program program;
        Buffer table;
        VkStridedDeviceAddressRegionKHR rayGeneration{}, miss{}, hit{};
    };
    static Pipeline makePipeline(Device& device, std::span<const ShaderModule> modules, bool occluded);
    void launch(CommandStream& stream, bool occluded, uint32_t count, const Bindings& call) override;
    void launchCounted(CommandStream& stream, bool occluded, const CountedRays& count, const Bindings& call) override;

    Pipeline closestHit_;
    Pipeline occluded_;
    PFN_vkCmdTraceRaysKHR traceRays_ = nullptr;
    PFN_vkCmdTraceRaysIndirectKHR traceRaysIndirect_ = nullptr;
};

}  // namespace voxray
