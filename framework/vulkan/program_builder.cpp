#include "vulkan/program_builder.h"

#include <algorithm>

#include "base/error.h"
#include "base/suggest.h"
#include "vulkan/structure.h"

namespace voxray {

ProgramBuilder::ProgramBuilder(Device& device, std::span<const ShaderModule> modules,
                               const SpecializationConstants& constants, VkPipelineBindPoint bindPoint)
    : device_(device) {
    program_.bindPoint_ = bindPoint;
    for (const ShaderModule& module : modules) {
        program_.name_ += (program_.name_.empty() ? "" : " + ") + module.file;
        program_.stages_ |= module.stage;
        program_.pushConstantBytes_ = std::max(program_.pushConstantBytes_, module.pushConstantBytes);
        if (module.pushMembers.size() > program_.pushMembers_.size()) program_.pushMembers_ = module.pushMembers;
        if (module.stage == VK_SHADER_STAGE_COMPUTE_BIT) program_.localSize_ = module.localSize;
        mergeBindings(module);
    }
    for (const ShaderModule& module : modules)
        if (!std::ranges::equal(module.pushMembers, std::span(program_.pushMembers_).first(module.pushMembers.size())))
            throw Error("{}: stages declare different push constants", program_.name_);
    makeLayout();
    makeStages(modules, constants);
}

void ProgramBuilder::mergeBindings(const ShaderModule& module) {
    for (const ShaderBinding& binding : module.bindings) {
        const auto known = std::ranges::find(program_.bindings_, binding.name, &ShaderBinding::name);
        if (known == program_.bindings_.end()) {
            program_.bindings_.push_back(binding);
            // Set 1 has only the textures.
            program_.bindings_.back().binding = binding.set == 0 ? uint32_t(program_.bindings_.size() - 1) : 0;
        } else if (known->set != binding.set || known->type != binding.type) {
            throw Error("{}: stages disagree on what '{}' is", program_.name_, binding.name);
        }
    }
}

std::vector<uint32_t> ProgramBuilder::numbered(const ShaderModule& module) const {
    std::vector<uint32_t> spirv = module.spirv;
    for (const ShaderBinding& binding : module.bindings) {
        const auto merged = std::ranges::find(program_.bindings_, binding.name, &ShaderBinding::name);
        spirv[binding.bindingWord] = merged->binding;
    }
    return spirv;
}

void ProgramBuilder::makeLayout() {
    // Set 0: one push descriptor per binding, visible to all stages.
    std::vector<VkDescriptorSetLayoutBinding> pushed;
    bool hasTextures = false;
    for (const ShaderBinding& binding : program_.bindings_) {
        if (binding.set == 0)
            pushed.push_back({binding.binding, binding.type, 1, program_.stages_, nullptr});
        else
            hasTextures = true;
    }
    const uint32_t maxPushed = device_.limits().pushDescriptors;
    if (pushed.size() > maxPushed)
        throw Error("{}: {} bindings in set 0; device '{}' allows {}", program_.name_, pushed.size(),
                    device_.info().name, maxPushed);
    auto set = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
    set.bindingCount = uint32_t(pushed.size());
    set.pBindings = pushed.data();
    check(
        vkCreateDescriptorSetLayout(device_.handle(), &set, nullptr, program_.pushSetLayout_.receive(device_.handle())),
        "vkCreateDescriptorSetLayout");

    // Set 1: the scene's textures.
    const VkDescriptorSetLayout sets[] = {program_.pushSetLayout_, device_.textureSetLayout()};
    const uint32_t limit = device_.properties().limits.maxPushConstantsSize;
    if (program_.pushConstantBytes_ > limit)
        throw Error("{}: {} bytes of push constants; device '{}' allows {}", program_.name_,
                    program_.pushConstantBytes_, device_.info().name, limit);
    const VkPushConstantRange range{program_.stages_, 0, program_.pushConstantBytes_};
    auto create = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    create.setLayoutCount = hasTextures ? 2 : 1;
    create.pSetLayouts = sets;
    create.pushConstantRangeCount = range.size > 0 ? 1 : 0;
    create.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(device_.handle(), &create, nullptr, program_.layout_.receive(device_.handle())),
          "vkCreatePipelineLayout");
}

uint32_t ProgramBuilder::constantId(std::span<const ShaderModule> modules, const std::string& name) const {
    std::vector<std::string> names;
    for (const ShaderModule& module : modules)
        for (const ShaderConstant& constant : module.constants) {
            if (constant.name == name) return constant.id;
            names.push_back(constant.name);
        }
    throw Error("{}: there is no specialization constant '{}'{}", program_.name_, name, didYouMean(name, names));
}

void ProgramBuilder::makeStages(std::span<const ShaderModule> modules, const SpecializationConstants& constants) {
    for (const auto& [name, value] : constants) {
        entries_.push_back({constantId(modules, name), uint32_t(values_.size() * sizeof(uint32_t)), sizeof(uint32_t)});
        values_.push_back(value);
    }
    specialization_ = {uint32_t(entries_.size()), entries_.data(), values_.size() * sizeof(uint32_t), values_.data()};
    for (const ShaderModule& module : modules) {
        auto create = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
        const std::vector<uint32_t> spirv = numbered(module);
        create.codeSize = spirv.size() * sizeof(uint32_t);
        create.pCode = spirv.data();
        check(
            vkCreateShaderModule(device_.handle(), &create, nullptr, modules_.emplace_back().receive(device_.handle())),
            "vkCreateShaderModule");
        auto stage = structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
        stage.stage = module.stage;
        stage.module = modules_.back();
        stage.pName = "main";
        stage.pSpecializationInfo = &specialization_;
        stages_.push_back(stage);
    }
}

}  // namespace voxray
