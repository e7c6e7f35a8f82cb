#include "trace/ray_pipeline_tracer.h"

#include <cstddef>
#include <cstring>

#include "shaders/trace/stream_count.h"

namespace voxray {

RayPipelineTracer::RayPipelineTracer(Device& device, ShaderCompiler& compiler, const SceneState& state,
                                     uint32_t trianglesPerChunk)
    : GpuTracer(device, state, trianglesPerChunk) {
    std::vector<ShaderModule> modules;
    for (const char* stage : {"rgen", "rmiss", "rchit", "rahit"})
        modules.push_back(*compiler.compile(std::string("shaders/trace/ray_pipeline.") + stage));
    closestHit_ = makePipeline(device, modules, false);
    occluded_ = makePipeline(device, modules, true);
    traceRays_ = device.function<PFN_vkCmdTraceRaysKHR>("vkCmdTraceRaysKHR");
    traceRaysIndirect_ = device.function<PFN_vkCmdTraceRaysIndirectKHR>("vkCmdTraceRaysIndirectKHR");
}

RayPipelineTracer::Pipeline RayPipelineTracer::makePipeline(Device& device, std::span<const ShaderModule> modules,
                                                            bool occluded) {
    Pipeline pipeline;
    pipeline.program = makeRayTracingProgram(device, modules, {{"kOccluded", occluded ? 1u : 0u}});

    // Shader group handles, one per aligned record.
    constexpr uint32_t kGroups = 3;
    const auto& properties = device.rayPipelineProperties();
    const size_t handleBytes = properties.shaderGroupHandleSize;
    const size_t alignment = properties.shaderGroupBaseAlignment;
    const size_t recordBytes = (handleBytes + alignment - 1) / alignment * alignment;
    std::vector<std::byte> handles(kGroups * handleBytes);
    check(device.function<PFN_vkGetRayTracingShaderGroupHandlesKHR>("vkGetRayTracingShaderGroupHandlesKHR")(
              device.handle(), pipeline.program.pipeline(), 0, kGroups, handles.size(), handles.data()),
          "vkGetRayTracingShaderGroupHandlesKHR");
    pipeline.table = Buffer(device, "shader binding table", (kGroups + 1) * recordBytes, MemoryKind::Upload,
                            VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR);
    const uint64_t padding = (alignment - pipeline.table.address() % alignment) % alignment;
    VkStridedDeviceAddressRegionKHR* regions[kGroups] = {&pipeline.rayGeneration, &pipeline.miss, &pipeline.hit};
    for (uint32_t group = 0; group < kGroups; ++group) {
        const uint64_t offset = padding + group * recordBytes;
        std::memcpy(static_cast<std::byte*>(pipeline.table.mapped()) + offset, &handles[group * handleBytes],
                    handleBytes);
        *regions[group] = {pipeline.table.address() + offset, recordBytes, recordBytes};
    }
    return pipeline;
}

void RayPipelineTracer::launch(CommandStream& stream, bool occluded, uint32_t count, const Bindings& call) {
    const Pipeline& pipeline = occluded ? occluded_ : closestHit_;
    stream.record(pipeline.program, call, [&](VkCommandBuffer commands) {
        const VkStridedDeviceAddressRegionKHR callable{};
        traceRays_(commands, &pipeline.rayGeneration, &pipeline.miss, &pipeline.hit, &callable, count, 1, 1);
    });
}

void RayPipelineTracer::launchCounted(CommandStream& stream, bool occluded, const CountedRays& count,
                                      const Bindings& call) {
    const Pipeline& pipeline = occluded ? occluded_ : closestHit_;
    const uint64_t command =
        count.counts.address() + count.index * sizeof(gpu::StreamCount) + offsetof(gpu::StreamCount, count);
    stream.record(pipeline.program, call, [&](VkCommandBuffer commands) {
        const VkStridedDeviceAddressRegionKHR callable{};
        traceRaysIndirect_(commands, &pipeline.rayGeneration, &pipeline.miss, &pipeline.hit, &callable, command);
    });
}

}  // namespace voxray
