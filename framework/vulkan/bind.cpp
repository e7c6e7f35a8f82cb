#include <algorithm>
#include <array>
#include <vector>

#include "base/error.h"
#include "base/suggest.h"
#include "vulkan/commands.h"
#include "vulkan/structure.h"

namespace voxray {
namespace {

const char* kindName(VkDescriptorType type) {
    switch (type) {
        case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
            return "a buffer";
        case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
            return "an image";
        case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
            return "an image or, in set 1, a texture array";
        default:
            return "an acceleration structure";
    }
}

const char* kindName(NumberKind kind) {
    constexpr std::array kNames{"an integer", "a float", "a 64-bit integer", "a struct"};
    return kNames[size_t(kind)];
}

bool isNumber(const Binding& binding) {
    return std::holds_alternative<Number>(binding.value);
}

/// The binding of a name, a resource or a number; optional ones come last. Null if there is none.
const Binding* find(std::span<const Binding> given, std::string_view name, bool asNumber) {
    const Binding* found = nullptr;
    for (const Binding& binding : given)
        if (binding.name == name && isNumber(binding) == asNumber && (!found || (found->optional && !binding.optional)))
            found = &binding;
    return found;
}

/// Strips the trailing underscore of GLSL names that would be keywords.
std::string_view withoutUnderscore(std::string_view name) {
    return name.substr(0, name.find_last_not_of('_') + 1);
}

/// @throws Error for a binding that is not declared, or given twice.
void checkUses(const Program& program, std::span<const Binding> given) {
    std::vector<std::string> names, numbers;
    for (const ShaderBinding& shaderBinding : program.bindings()) names.push_back(shaderBinding.name);
    for (const ShaderPushMember& member : program.pushMembers()) numbers.emplace_back(withoutUnderscore(member.name));
    for (const Binding& binding : given) {
        const std::vector<std::string>& declared = isNumber(binding) ? numbers : names;
        if (!binding.optional && std::ranges::find(declared, binding.name) == declared.end())
            throw Error("{}: there is no {} '{}'{}", program.name(), isNumber(binding) ? "push constant" : "binding",
                        binding.name, didYouMean(binding.name, declared));
        const auto isSame = [&](const Binding& other) {
            return other.name == binding.name && other.optional == binding.optional &&
                   isNumber(other) == isNumber(binding);
        };
        if (std::ranges::count_if(given, isSame) > 1)
            throw Error("{}: binding '{}' is given twice", program.name(), binding.name);
    }
}

/// The given binding for each one that the program declares.
std::vector<const Binding*> matchBindings(const Program& program, std::span<const Binding> given) {
    std::vector<const Binding*> matched;
    for (const ShaderBinding& shaderBinding : program.bindings()) {
        const Binding* found = find(given, shaderBinding.name, false);
        if (!found) throw Error("{}: binding '{}' is not given", program.name(), shaderBinding.name);
        matched.push_back(found);
    }
    return matched;
}

/// The push constant block, from the numbers among the bindings.
std::vector<std::byte> pushBlock(const Program& program, std::span<const Binding> given) {
    std::vector<std::byte> block(program.pushConstantBytes());
    for (const ShaderPushMember& member : program.pushMembers()) {
        const Binding* found = find(given, withoutUnderscore(member.name), true);
        if (!found) throw Error("{}: push constant '{}' is not given", program.name(), member.name);
        const Number* number = std::get_if<Number>(&found->value);
        if (number->kind() != member.kind || number->bytes() != member.bytes)
            throw Error("{}: push constant '{}' is {} of {} bytes, given is {} of {}", program.name(), member.name,
                        kindName(member.kind), member.bytes, kindName(number->kind()), number->bytes());
        std::copy_n(number->data(), number->bytes(), block.begin() + member.offset);
    }
    return block;
}

/// Descriptor writes of one call, with the structures that they point to.
class Writes {
 public:
    Writes(const Device& device, const Program& program, size_t count) : device_(device), program_(program) {
        buffers_.reserve(count);
        images_.reserve(count);
        structures_.reserve(count);
    }

    void add(const ShaderBinding& shaderBinding, const Binding& given) {
        auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstBinding = shaderBinding.binding;
        write.descriptorCount = 1;
        write.descriptorType = shaderBinding.type;
        if (const auto* buffer = std::get_if<const Buffer*>(&given.value)) {
            expect(shaderBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
            write.pBufferInfo = &buffers_.emplace_back(bufferInfo(shaderBinding, **buffer));
        } else if (const auto* image = std::get_if<const Image*>(&given.value)) {
            if (!**image) throw Error("{}: the image bound to '{}' is empty", program_.name(), shaderBinding.name);
            const bool isSampled = shaderBinding.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            expect(shaderBinding, isSampled || given.sampler ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                                             : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
            const VkImageView view = isSampled ? (*image)->view() : (*image)->levelView(given.level);
            const VkSampler sampler = !isSampled      ? VK_NULL_HANDLE
                                      : given.sampler ? given.sampler->handle()
                                                      : device_.texelSampler();
            write.pImageInfo = &images_.emplace_back(sampler, view, VK_IMAGE_LAYOUT_GENERAL);
        } else if (const auto* structure = std::get_if<VkAccelerationStructureKHR>(&given.value)) {
            expect(shaderBinding, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR);
            write.pNext = &structures_.emplace_back(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR,
                                                    nullptr, 1u, structure);
        } else {
            refuse(shaderBinding);
        }
        writes_.push_back(write);
    }

    const std::vector<VkWriteDescriptorSet>& list() const { return writes_; }

 private:
    VkDescriptorBufferInfo bufferInfo(const ShaderBinding& shaderBinding, const Buffer& buffer) const {
        const uint64_t limit = device_.properties().limits.maxStorageBufferRange;
        if (buffer.bytes() > limit)
            throw Error(
                "{}: buffer '{}' bound to '{}' holds {} bytes, but device '{}' binds at most {}; "
                "use the buffer's address instead (GL_EXT_buffer_reference)",
                program_.name(), buffer.name(), shaderBinding.name, buffer.bytes(), device_.info().name, limit);
        if (!buffer) throw Error("{}: the buffer bound to '{}' is empty", program_.name(), shaderBinding.name);
        return {buffer.handle(), 0, VK_WHOLE_SIZE};
    }

    void expect(const ShaderBinding& shaderBinding, VkDescriptorType given) const {
        if (shaderBinding.set != 0 || shaderBinding.type != given) refuse(shaderBinding);
    }
    [[noreturn]] void refuse(const ShaderBinding& shaderBinding) const {
        throw Error("{}: binding '{}' takes {}", program_.name(), shaderBinding.name, kindName(shaderBinding.type));
    }

    const Device& device_;
    const Program& program_;
    std::vector<VkDescriptorBufferInfo> buffers_;
    std::vector<VkDescriptorImageInfo> images_;
    std::vector<VkWriteDescriptorSetAccelerationStructureKHR> structures_;
    std::vector<VkWriteDescriptorSet> writes_;
};

}  // namespace

void CommandStream::bind(VkCommandBuffer buffer, const Program& program, std::span<const Binding> given) {
    checkUses(program, given);
    vkCmdBindPipeline(buffer, program.bindPoint(), program.pipeline());
    if (const std::vector<std::byte> block = pushBlock(program, given); !block.empty())
        vkCmdPushConstants(buffer, program.layout(), program.stages(), 0, uint32_t(block.size()), block.data());

    // Set 0 is pushed; the texture array is a descriptor set.
    const std::vector<const Binding*> matched = matchBindings(program, given);
    Writes writes(device_, program, matched.size());
    for (size_t i = 0; i < matched.size(); ++i) {
        const ShaderBinding& shaderBinding = program.bindings()[i];
        const auto* textures = std::get_if<const TextureArray*>(&matched[i]->value);
        if (shaderBinding.set == 0 || !textures) {
            writes.add(shaderBinding, *matched[i]);
            continue;
        }
        const VkDescriptorSet set = (*textures)->set();
        vkCmdBindDescriptorSets(buffer, program.bindPoint(), program.layout(), 1, 1, &set, 0, nullptr);
    }
    if (!writes.list().empty())
        pushDescriptors_(buffer, program.bindPoint(), program.layout(), 0, uint32_t(writes.list().size()),
                         writes.list().data());
}

}  // namespace voxray
