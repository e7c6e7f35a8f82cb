#include "vulkan/program.h"

#include <algorithm>

#include "base/error.h"
#include "vulkan/program_builder.h"
#include "vulkan/structure.h"

namespace voxray {
namespace {

const ShaderModule* find(std::span<const ShaderModule> modules, VkShaderStageFlagBits stage) {
    const auto found = std::ranges::find(modules, stage, &ShaderModule::stage);
    return found == modules.end() ? nullptr : &*found;
}

}  // namespace

Program makeComputeProgram(Device& device, const ShaderModule& module, const SpecializationConstants& constants) {
    ProgramBuilder builder(device, {&module, 1}, constants, VK_PIPELINE_BIND_POINT_COMPUTE);
    auto create = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    create.stage = builder.stages()[0];
    create.layout = builder.layout();
    check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &create, nullptr, builder.receivePipeline()),
          module.file.c_str());
    return builder.finish();
}

Program makeRasterProgram(Device& device, std::span<const ShaderModule> modules, const RasterState& state,
                          const SpecializationConstants& constants) {
    const ShaderModule* geometry = find(modules, VK_SHADER_STAGE_GEOMETRY_BIT);
    if (geometry && !device.info().geometryShader)
        throw Error("{}: device '{}' has no geometry shaders (feature geometryShader)", geometry->file,
                    device.info().name);
    ProgramBuilder builder(device, modules, constants, VK_PIPELINE_BIND_POINT_GRAPHICS);

    const DeviceInfo& info = device.info();
    if (state.isConservative && !info.conservativeRaster)
        throw Error("{}: device '{}' lacks VK_EXT_conservative_rasterization", modules.front().file, info.name);
    if (!(info.sampleCounts & state.samples))
        throw Error("{}: device '{}' has no {} samples a pixel without attachments", modules.front().file, info.name,
                    state.samples);

    // Triangles without vertex inputs, no blending.
    auto vertexInput =
        structure<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    auto assembly =
        structure<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto viewport = structure<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewport.viewportCount = viewport.scissorCount = state.viewports;
    auto raster =
        structure<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    raster.cullMode = state.cull;
    raster.frontFace = state.frontFace;
    raster.lineWidth = 1.0f;
    auto conservative = structure<VkPipelineRasterizationConservativeStateCreateInfoEXT>(
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_CONSERVATIVE_STATE_CREATE_INFO_EXT);
    conservative.conservativeRasterizationMode = VK_CONSERVATIVE_RASTERIZATION_MODE_OVERESTIMATE_EXT;
    conservative.extraPrimitiveOverestimationSize = info.rasterOverestimation;
    if (state.isConservative) raster.pNext = &conservative;
    auto samples =
        structure<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = VkSampleCountFlagBits(state.samples);

    // Depth is tested and written if there is a depth target.
    auto depth =
        structure<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = depth.depthWriteEnable = state.depthFormat != VK_FORMAT_UNDEFINED;
    depth.depthCompareOp = state.depthCompare;
    VkPipelineColorBlendAttachmentState target{};
    if (state.writeColor)
        target.colorWriteMask =
            VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    const std::vector<VkPipelineColorBlendAttachmentState> targets(state.colorFormats.size(), target);
    auto blend =
        structure<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = uint32_t(targets.size());
    blend.pAttachments = targets.data();

    // Viewport and scissor are dynamic.
    const VkDynamicState dynamicStates[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    auto dynamic = structure<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamicStates;
    auto rendering = structure<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
    rendering.colorAttachmentCount = uint32_t(state.colorFormats.size());
    rendering.pColorAttachmentFormats = state.colorFormats.data();
    rendering.depthAttachmentFormat = state.depthFormat;

    auto create = structure<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering);
    create.stageCount = uint32_t(builder.stages().size());
    create.pStages = builder.stages().data();
    create.pVertexInputState = &vertexInput;
    create.pInputAssemblyState = &assembly;
    create.pViewportState = &viewport;
    create.pRasterizationState = &raster;
    create.pMultisampleState = &samples;
    create.pDepthStencilState = &depth;
    create.pColorBlendState = &blend;
    create.pDynamicState = &dynamic;
    create.layout = builder.layout();
    check(vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &create, nullptr, builder.receivePipeline()),
          modules[0].file.c_str());
    return builder.finish();
}

Program makeRayTracingProgram(Device& device, std::span<const ShaderModule> modules,
                              const SpecializationConstants& constants) {
    if (!device.info().rayPipeline)
        throw Error("device '{}' has no ray-tracing pipelines (VK_KHR_ray_tracing_pipeline)", device.info().name);
    ProgramBuilder builder(device, modules, constants, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR);

    // General groups in the modules' order, then one triangle hit group of the hit shaders.
    auto empty =
        structure<VkRayTracingShaderGroupCreateInfoKHR>(VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR);
    empty.generalShader = empty.closestHitShader = VK_SHADER_UNUSED_KHR;
    empty.anyHitShader = empty.intersectionShader = VK_SHADER_UNUSED_KHR;
    std::vector<VkRayTracingShaderGroupCreateInfoKHR> groups;
    VkRayTracingShaderGroupCreateInfoKHR hit = empty;
    hit.type = VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
    for (uint32_t i = 0; i < modules.size(); ++i) {
        if (modules[i].stage == VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR) {
            hit.closestHitShader = i;
        } else if (modules[i].stage == VK_SHADER_STAGE_ANY_HIT_BIT_KHR) {
            hit.anyHitShader = i;
        } else {
            groups.push_back(empty);
            groups.back().type = VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
            groups.back().generalShader = i;
        }
    }
    groups.push_back(hit);

    auto create = structure<VkRayTracingPipelineCreateInfoKHR>(VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR);
    create.stageCount = uint32_t(builder.stages().size());
    create.pStages = builder.stages().data();
    create.groupCount = uint32_t(groups.size());
    create.pGroups = groups.data();
    create.maxPipelineRayRecursionDepth = 1;
    create.layout = builder.layout();
    const auto createPipelines = device.function<PFN_vkCreateRayTracingPipelinesKHR>("vkCreateRayTracingPipelinesKHR");
    check(createPipelines(device.handle(), VK_NULL_HANDLE, VK_NULL_HANDLE, 1, &create, nullptr,
                          builder.receivePipeline()),
          modules[0].file.c_str());
    return builder.finish();
}

}  // namespace voxray
