#include <utility>
#include <vector>

#include "base/error.h"
#include "vulkan/memory.h"
#include "vulkan/structure.h"

namespace voxray {

Sampler::Sampler(Device& device, Filter filter, VkSamplerAddressMode wrapU, VkSamplerAddressMode wrapV)
    : Sampler() {
    device_ = &device;
    const bool linear = filter == Filter::Linear;
    auto create = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    create.magFilter = create.minFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    create.mipmapMode = linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    create.addressModeU = wrapU;
    create.addressModeV = wrapV;
    create.addressModeW = wrapV;
    create.maxLod = VK_LOD_CLAMP_NONE;
    check(vkCreateSampler(device.handle(), &create, nullptr, &handle_), "vkCreateSampler");
}

Sampler::~Sampler() {
    if (device_) vkDestroySampler(device_->handle(), handle_, nullptr);
}

Sampler::Sampler(Sampler&& other) noexcept {
    *this = std::move(other);
}

Sampler& Sampler::operator=(Sampler&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
}

// Delegating first makes the destructor clean up where the rest throws.
TextureArray::TextureArray(Device& device, std::span<const Entry> entries) : TextureArray() {
    device_ = &device;
    const uint32_t count = uint32_t(entries.size());
    if (count == 0) throw Error("a texture array needs at least one texture");
    if (entries.size() > device.maxTextures())
        throw Error("the scene has {} textures; at most {} are supported", entries.size(),
                    device.maxTextures());

    // A pool for one set of the array's length.
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count};
    auto pool = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(vkCreateDescriptorPool(device.handle(), &pool, nullptr, &pool_), "vkCreateDescriptorPool");
    const VkDescriptorSetLayout layout = device.textureSetLayout();
    VkDescriptorSetVariableDescriptorCountAllocateInfo length{
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_VARIABLE_DESCRIPTOR_COUNT_ALLOCATE_INFO, nullptr, 1, &count};
    auto allocate =
        structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, &length);
    allocate.descriptorPool = pool_;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    check(vkAllocateDescriptorSets(device.handle(), &allocate, &set_), "vkAllocateDescriptorSets");

    // All entries in one write.
    std::vector<VkDescriptorImageInfo> infos;
    for (const Entry& entry : entries)
        infos.push_back({entry.sampler->handle(), entry.image->view(), VK_IMAGE_LAYOUT_GENERAL});
    auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set_;
    write.descriptorCount = count;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = infos.data();
    vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
}

TextureArray::~TextureArray() {
    if (device_) vkDestroyDescriptorPool(device_->handle(), pool_, nullptr);
}

TextureArray::TextureArray(TextureArray&& other) noexcept {
    *this = std::move(other);
}

TextureArray& TextureArray::operator=(TextureArray&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    std::swap(set_, other.set_);
    return *this;
}

}  // namespace voxray
