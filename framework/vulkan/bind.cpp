#include <algorithm>
#include <vector>

#include "base/error.h"
#include "base/suggest.h"
#include "vulkan/commands_impl.h"
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
    switch (kind) {
        case NumberKind::Integer:
            return "an integer";
        case NumberKind::Float:
            return "a float";
        case NumberKind::Address:
            return "a 64-bit integer";
        default:
            return "a struct";
    }
}

bool isNumber(const Binding& binding) {
    return std::holds_alternative<Number>(binding.value);
}

/// What is given under a name, as a resource or as a number; what a resource brings along comes last. Null
/// where there is none.
const Binding* find(std::span<const Binding> given, std::string_view name, bool asNumber) {
    const Binding* found = nullptr;
    for (const Binding& binding : given)
        if (binding.name == name && isNumber(binding) == asNumber &&
            (!found || (found->optional && !binding.optional)))
            found = &binding;
    return found;
}

/// In GLSL a trailing underscore tells a name from a keyword.
std::string_view withoutUnderscore(std::string_view name) {
    return name.substr(0, name.find_last_not_of('_') + 1);
}

/// @throws Error for what is given and not declared, and for what is given twice.
void checkUses(const Program& program, std::span<const Binding> given) {
    std::vector<std::string> names, numbers;
    for (const ShaderBinding& wanted : program.bindings()) names.push_back(wanted.name);
    for (const ShaderPushMember& wanted : program.pushMembers())
        numbers.emplace_back(withoutUnderscore(wanted.name));
    for (const Binding& binding : given) {
        const std::vector<std::string>& known = isNumber(binding) ? numbers : names;
        if (!binding.optional && std::ranges::find(known, binding.name) == known.end())
            throw Error("{}: there is no {} '{}'{}", program.name(),
                        isNumber(binding) ? "push constant" : "binding", binding.name,
                        didYouMean(binding.name, known));
        const auto isSame = [&](const Binding& other) {
            return other.name == binding.name && other.optional == binding.optional &&
                   isNumber(other) == isNumber(binding);
        };
        if (std::ranges::count_if(given, isSame) > 1)
            throw Error("{}: binding '{}' is given twice", program.name(), binding.name);
    }
}

/// Every binding of a program with what is given for it.
std::vector<const Binding*> matchBindings(const Program& program, std::span<const Binding> given) {
    std::vector<const Binding*> matched;
    for (const ShaderBinding& wanted : program.bindings()) {
        const Binding* found = find(given, wanted.name, false);
        if (!found) throw Error("{}: binding '{}' is not given", program.name(), wanted.name);
        matched.push_back(found);
    }
    return matched;
}

/// The block of push constants out of the numbers among the bindings.
std::vector<std::byte> pushBlock(const Program& program, std::span<const Binding> given) {
    std::vector<std::byte> block(program.pushConstantBytes());
    for (const ShaderPushMember& member : program.pushMembers()) {
        const Binding* found = find(given, withoutUnderscore(member.name), true);
        if (!found) throw Error("{}: push constant '{}' is not given", program.name(), member.name);
        const Number* number = std::get_if<Number>(&found->value);
        if (number->kind() != member.kind || number->bytes() != member.bytes)
            throw Error("{}: push constant '{}' is {} of {} bytes, given is {} of {}", program.name(),
                        member.name, kindName(member.kind), member.bytes, kindName(number->kind()),
                        number->bytes());
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

    void add(const ShaderBinding& wanted, const Binding& given) {
        auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstBinding = wanted.binding;
        write.descriptorCount = 1;
        write.descriptorType = wanted.type;
        if (const auto* buffer = std::get_if<const Buffer*>(&given.value)) {
            expect(wanted, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
            write.pBufferInfo = &buffers_.emplace_back(bufferInfo(wanted, **buffer));
        } else if (const auto* image = std::get_if<const Image*>(&given.value)) {
            const bool isSampled = wanted.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            expect(wanted, isSampled || given.sampler ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                                      : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
            const VkImageView view = isSampled ? (*image)->view() : (*image)->levelView(given.level);
            const VkSampler sampler = !isSampled      ? VK_NULL_HANDLE
                                      : given.sampler ? given.sampler->handle()
                                                      : device_.texelSampler();
            write.pImageInfo = &images_.emplace_back(sampler, view, VK_IMAGE_LAYOUT_GENERAL);
        } else if (const auto* structure = std::get_if<VkAccelerationStructureKHR>(&given.value)) {
            expect(wanted, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR);
            write.pNext = &structures_.emplace_back(
                VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR, nullptr, 1u, structure);
        } else {
            refuse(wanted);
        }
        writes_.push_back(write);
    }

    const std::vector<VkWriteDescriptorSet>& list() const { return writes_; }

 private:
    VkDescriptorBufferInfo bufferInfo(const ShaderBinding& wanted, const Buffer& buffer) const {
        const uint64_t limit = device_.properties().limits.maxStorageBufferRange;
        if (buffer.bytes() > limit)
            throw Error(
                "{}: buffer '{}' bound to '{}' holds {} bytes, but device '{}' binds at most {}; use the "
                "buffer's address instead (GL_EXT_buffer_reference)",
                program_.name(), buffer.name(), wanted.name, buffer.bytes(), device_.info().name, limit);
        if (!buffer) throw Error("{}: the buffer bound to '{}' is empty", program_.name(), wanted.name);
        return {buffer.handle(), 0, VK_WHOLE_SIZE};
    }

    void expect(const ShaderBinding& wanted, VkDescriptorType given) const {
        if (wanted.set != 0 || wanted.type != given) refuse(wanted);
    }
    [[noreturn]] void refuse(const ShaderBinding& wanted) const {
        throw Error("{}: binding '{}' takes {}", program_.name(), wanted.name, kindName(wanted.type));
    }

    const Device& device_;
    const Program& program_;
    std::vector<VkDescriptorBufferInfo> buffers_;
    std::vector<VkDescriptorImageInfo> images_;
    std::vector<VkWriteDescriptorSetAccelerationStructureKHR> structures_;
    std::vector<VkWriteDescriptorSet> writes_;
};

}  // namespace

void CommandStream::Impl::bind(VkCommandBuffer buffer, const Program& program,
                               std::span<const Binding> given) {
    checkUses(program, given);
    vkCmdBindPipeline(buffer, program.bindPoint(), program.pipeline());
    if (const std::vector<std::byte> block = pushBlock(program, given); !block.empty())
        vkCmdPushConstants(buffer, program.layout(), program.stages(), 0, uint32_t(block.size()),
                           block.data());

    // Set 0 is pushed, the texture array is bound as a set of its own.
    const std::vector<const Binding*> matched = matchBindings(program, given);
    Writes writes(device, program, matched.size());
    for (size_t i = 0; i < matched.size(); ++i) {
        const ShaderBinding& wanted = program.bindings()[i];
        const auto* textures = std::get_if<const TextureArray*>(&matched[i]->value);
        if (wanted.set == 0 || !textures) {
            writes.add(wanted, *matched[i]);
            continue;
        }
        const VkDescriptorSet set = (*textures)->set();
        vkCmdBindDescriptorSets(buffer, program.bindPoint(), program.layout(), 1, 1, &set, 0, nullptr);
    }
    if (!writes.list().empty())
        pushDescriptors(buffer, program.bindPoint(), program.layout(), 0, uint32_t(writes.list().size()),
                        writes.list().data());
}

}  // namespace voxray
