#pragma once

#include <span>
#include <utility>
#include <vector>

#include "vulkan/program.h"

/// Common part of the three kinds of pipeline. Internal to the vulkan layer.
namespace voxray {

/// Builds a Program's layout from its modules; owns shader modules and specialization data until the pipeline
/// is created.
class ProgramBuilder {
 public:
    /// @throws Error if stages disagree on a binding, a constant is unknown, or limits are exceeded.
    ProgramBuilder(Device& device, std::span<const ShaderModule> modules, const SpecializationConstants& constants,
                   VkPipelineBindPoint bindPoint);
    ProgramBuilder(const ProgramBuilder&) = delete;
    ProgramBuilder& operator=(const ProgramBuilder&) = delete;

    std::span<const VkPipelineShaderStageCreateInfo> stages() const { return stages_; }
    VkPipelineLayout layout() const { return program_.layout_; }

    /// Where a vkCreate function writes the pipeline.
    VkPipeline* receivePipeline() { return program_.pipeline_.receive(device_.handle()); }
    /// The program with its pipeline.
    Program finish() { return std::move(program_); }

 private:
    /// Assigns a binding number to each name: stages and files share names, not numbers.
    void mergeBindings(const ShaderModule& module);
    /// The module's SPIR-V with the program's binding numbers.
    std::vector<uint32_t> numbered(const ShaderModule& module) const;
    /// @throws Error if no stage has a constant of that name.
    uint32_t constantId(std::span<const ShaderModule> modules, const std::string& name) const;
    void makeLayout();
    void makeStages(std::span<const ShaderModule> modules, const SpecializationConstants& constants);

    Device& device_;
    Program program_;
    std::vector<UniqueHandle<VkShaderModule, vkDestroyShaderModule>> modules_;
    std::vector<VkSpecializationMapEntry> entries_;
    std::vector<uint32_t> values_;
    VkSpecializationInfo specialization_{};
    std::vector<VkPipelineShaderStageCreateInfo> stages_;
};

}  // namespace voxray
