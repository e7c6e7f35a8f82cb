#include <glm/common.hpp>
#include <utility>

#include "vulkan/allocate.h"
#include "vulkan/live_memory.h"
#include "vulkan/memory.h"
#include "vulkan/size_error.h"
#include "vulkan/structure.h"

namespace voxray {

uint32_t texelBytes(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8_UNORM:
            return 1;
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_R8G8B8A8_SRGB:
        case VK_FORMAT_R16G16_SFLOAT:
        case VK_FORMAT_R32_UINT:
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_D32_SFLOAT:
            return 4;
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            return 8;
        case VK_FORMAT_R32G32B32A32_UINT:
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return 16;
        default:
            throw Error("image format {} is not one that Voxray uses", int(format));
    }
}

VkImageAspectFlags aspectOf(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

uint64_t imageBytes(const ImageDesc& desc) {
    uint64_t texels = 0;
    for (uint32_t level = 0; level < desc.mipLevels; ++level) {
        const glm::u64vec3 size = glm::max(desc.extent >> level, glm::uvec3(1));
        texels += size.x * size.y * size.z;
    }
    return texels * texelBytes(desc.format);
}

namespace {

VkImageCreateInfo describe(const ImageDesc& desc) {
    auto create = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    create.imageType = desc.extent.z > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
    create.format = desc.format;
    create.extent = {desc.extent.x, desc.extent.y, desc.extent.z};
    create.mipLevels = desc.mipLevels;
    create.arrayLayers = 1;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.tiling = VK_IMAGE_TILING_OPTIMAL;
    create.usage = desc.usage;
    return create;
}

void checkSupported(const Device& device, const std::string& name, const VkImageCreateInfo& create) {
    VkImageFormatProperties offered{};
    const VkResult result = vkGetPhysicalDeviceImageFormatProperties(device.physical(), create.format, create.imageType,
                                                                     create.tiling, create.usage, 0, &offered);
    if (result != VK_SUCCESS)
        throw Error("device '{}' can't make image '{}': format {} with usage {:#x}", device.info().name, name,
                    int(create.format), create.usage);
    const VkExtent3D &wanted = create.extent, &largest = offered.maxExtent;
    if (wanted.width > largest.width || wanted.height > largest.height || wanted.depth > largest.depth ||
        create.mipLevels > offered.maxMipLevels)
        throw SizeError("image '{}' of {}x{}x{} texels and {} levels is over device '{}''s {}x{}x{} and {}", name,
                        wanted.width, wanted.height, wanted.depth, create.mipLevels, device.info().name, largest.width,
                        largest.height, largest.depth, offered.maxMipLevels);
}

VkImageView makeView(const Device& device, VkImage image, const ImageDesc& desc, uint32_t level, uint32_t levels) {
    auto create = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    create.image = image;
    create.viewType = desc.extent.z > 1 ? VK_IMAGE_VIEW_TYPE_3D : VK_IMAGE_VIEW_TYPE_2D;
    create.format = desc.format;
    create.subresourceRange = {aspectOf(desc.format), level, levels, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device.handle(), &create, nullptr, &view), "vkCreateImageView");
    return view;
}

}  // namespace

// Delegating first makes the destructor clean up where the rest throws.
Image::Image(Device& device, std::string name, const ImageDesc& desc) : Image() {
    device_ = &device;
    name_ = std::move(name);
    desc_ = desc;
    number_ = device.liveMemory().add(nullptr, this);
    if (desc.extent.x == 0 || desc.extent.y == 0 || desc.extent.z == 0 || desc.mipLevels == 0)
        throw Error("image '{}' would hold no texel", name_);
    if (device.isHost()) {
        memory_.bytes = imageBytes(desc);
        device.reserveMemory(memory_.bytes, name_);
        host_ = std::make_unique<std::byte[]>(memory_.bytes);
        return;
    }
    const VkImageCreateInfo create = describe(desc);
    checkSupported(device, name_, create);
    check(vkCreateImage(device.handle(), &create, nullptr, &handle_), "vkCreateImage");
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device.handle(), handle_, &requirements);
    memory_ = allocateMemory(device, name_, requirements, MemoryKind::Device, false);
    check(vkBindImageMemory(device.handle(), handle_, memory_.handle, 0), "vkBindImageMemory");

    // A view of all levels and one per level; transfer-only images have none.
    constexpr VkImageUsageFlags kViewed = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                          VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (desc.usage & kViewed) {
        view_ = makeView(device, handle_, desc, 0, desc.mipLevels);
        levelViews_.resize(desc.mipLevels, VK_NULL_HANDLE);
        for (uint32_t level = 0; level < desc.mipLevels; ++level)
            levelViews_[level] = makeView(device, handle_, desc, level, 1);
    }

    // The image keeps this layout.
    device.runNow([&](VkCommandBuffer commands) {
        auto barrier = structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = handle_;
        barrier.subresourceRange = {aspectOf(desc.format), 0, desc.mipLevels, 0, 1};
        auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
        dependency.imageMemoryBarrierCount = 1;
        dependency.pImageMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands, &dependency);
    });
}

Image::~Image() {
    if (!device_) return;
    device_->liveMemory().remove(number_);
    if (host_) device_->releaseMemory(memory_.bytes, name_);
    if (device_->isHost()) return;
    for (VkImageView view : levelViews_) vkDestroyImageView(device_->handle(), view, nullptr);
    vkDestroyImageView(device_->handle(), view_, nullptr);
    vkDestroyImage(device_->handle(), handle_, nullptr);
    if (memory_.handle) freeMemory(*device_, name_, memory_);
}

Image::Image(Image&& other) noexcept {
    *this = std::move(other);
}

Image& Image::operator=(Image&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(number_, other.number_);
    std::swap(name_, other.name_);
    std::swap(desc_, other.desc_);
    std::swap(handle_, other.handle_);
    std::swap(memory_, other.memory_);
    std::swap(view_, other.view_);
    std::swap(levelViews_, other.levelViews_);
    std::swap(host_, other.host_);
    for (const Image* image : {this, &other})
        if (image->device_) image->device_->liveMemory().move(image->number_, nullptr, image);
    return *this;
}

VkImageView Image::levelView(uint32_t level) const {
    if (level >= levelViews_.size())
        throw Error("image '{}' has {} viewable levels, not level {}", name_, levelViews_.size(), level);
    return levelViews_[level];
}

}  // namespace voxray
