#include <vector>

#include "base/error.h"
#include "vulkan/memory.h"
#include "vulkan/structure.h"

namespace voxray {

Sampler::Sampler(Device& device, Filter filter, VkSamplerAddressMode wrapU, VkSamplerAddressMode wrapV) {
    const bool linear = filter == Filter::Linear;
    auto create = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    create.magFilter = create.minFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    create.mipmapMode = linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    create.addressModeU = wrapU;
    create.addressModeV = wrapV;
    create.addressModeW = wrapV;
    create.maxLod = VK_LOD_CLAMP_NONE;
    check(vkCreateSampler(device.handle(), &create, nullptr, handle_.receive(device.handle())), "vkCreateSampler");
}

TextureArray::TextureArray(Device& device, std::span<const Entry> entries) {
    const uint32_t count = uint32_t(entries.size());
    if (count == 0) throw Error("a texture array needs at least one texture");
    if (entries.size() > device.limits().textures)
        throw Error("the scene has {} textures; at most {} are supported", entries.size(), device.limits().textures);

    // A pool for one set of the array's length.
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count};
    auto create = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    create.maxSets = 1;
    create.poolSizeCount = 1;
    create.pPoolSizes = &size;
    check(vkCreateDescriptorPool(device.handle(), &create, nullptr, pool_.receive(device.handle())),
          "vkCreateDescriptorPool");
    const VkDescriptorSetLayout layout = device.textureSetLayout();
    VkDescriptorSetVariableDescriptorCountAllocateInfo length{
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_VARIABLE_DESCRIPTOR_COUNT_ALLOCATE_INFO, nullptr, 1, &count};
    auto allocate = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, &length);
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

}  // namespace voxray
