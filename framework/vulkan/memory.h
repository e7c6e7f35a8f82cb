#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/unique_handle.h"

namespace voxray {

/// Memory of a buffer. On software Vulkan all kinds are mapped.
enum class MemoryKind {
    Device,    ///< Fast for the device; mapped only if the device shares memory with the host.
    Upload,    ///< Host writes, device reads.
    Readback,  ///< Device writes, host reads.
};

/// A driver allocation, of a buffer or an image.
struct DeviceMemory {
    VkDeviceMemory handle = VK_NULL_HANDLE;
    uint64_t bytes = 0;  ///< Including the driver's padding.
    uint32_t type = 0;   ///< Index of the memory type.
    bool addressable = false;
};

/// A storage buffer with a device address. Move-only. Usable as storage, indirect, index and vertex buffer,
/// transfer source and target, and as input of acceleration structures.
class Buffer {
 public:
    Buffer() = default;
    /// @throws Error if the size is 0 or over the device's or the configured memory limit.
    Buffer(Device& device, std::string name, uint64_t bytes, MemoryKind kind = MemoryKind::Device,
           VkBufferUsageFlags extraUsage = 0);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    explicit operator bool() const { return device_ != nullptr; }
    const std::string& name() const { return name_; }
    uint64_t bytes() const { return bytes_; }
    VkBuffer handle() const { return handle_; }
    VkDeviceAddress address() const { return address_; }
    /// Mapped memory, or nullptr. Writes of the device are visible after CommandStream::finish().
    void* mapped() const { return mapped_; }
    template <typename T>
    std::span<T> mappedAs() const {
        return {static_cast<T*>(mapped_), mapped_ ? bytes_ / sizeof(T) : 0};
    }

 private:
    Device* device_ = nullptr;
    uint64_t number_ = 0;  ///< In Device::liveMemory(); 0: not there.
    std::string name_;
    uint64_t bytes_ = 0;
    VkBuffer handle_ = VK_NULL_HANDLE;
    DeviceMemory memory_;
    VkDeviceAddress address_ = 0;
    void* mapped_ = nullptr;
    std::unique_ptr<std::byte[]> host_;  ///< Without Vulkan.
};

/// Description of an image; 3D if `extent.z` > 1.
struct ImageDesc {
    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    glm::uvec3 extent{1, 1, 1};
    uint32_t mipLevels = 1;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
};

/// Bytes of an image with its mip levels, without the driver's padding.
uint64_t imageBytes(const ImageDesc& desc);

/// Bytes of a texel (a depth texel for depth formats). @throws Error for a format that Voxray doesn't use.
uint32_t texelBytes(VkFormat format);

/// Depth or colour aspect of a format.
VkImageAspectFlags aspectOf(VkFormat format);

/// An image with a view of all its levels, in VK_IMAGE_LAYOUT_GENERAL from its creation on, with undefined
/// contents. Move-only.
class Image {
 public:
    Image() = default;
    /// @throws Error if the device can't make such an image, or the memory limit would be exceeded.
    Image(Device& device, std::string name, const ImageDesc& desc);
    ~Image();
    Image(Image&& other) noexcept;
    Image& operator=(Image&& other) noexcept;

    explicit operator bool() const { return device_ != nullptr; }
    const std::string& name() const { return name_; }
    const ImageDesc& desc() const { return desc_; }
    uint64_t bytes() const { return memory_.bytes; }  ///< Including the driver's padding.
    VkImage handle() const { return handle_; }
    VkImageView view() const { return view_; }
    VkImageView levelView(uint32_t level) const;  ///< One mip level, for storage access.
    /// All levels, tightly packed; nullptr with Vulkan.
    std::byte* hostTexels() const { return host_.get(); }

 private:
    Device* device_ = nullptr;
    uint64_t number_ = 0;  ///< In Device::liveMemory().
    std::string name_;
    ImageDesc desc_;
    VkImage handle_ = VK_NULL_HANDLE;
    DeviceMemory memory_;
    VkImageView view_ = VK_NULL_HANDLE;
    std::vector<VkImageView> levelViews_;
    std::unique_ptr<std::byte[]> host_;
};

enum class Filter { Nearest, Linear };

/// A sampler. Move-only.
class Sampler {
 public:
    Sampler() = default;
    Sampler(Device& device, Filter filter, VkSamplerAddressMode wrapU, VkSamplerAddressMode wrapV);
    VkSampler handle() const { return handle_; }

 private:
    UniqueHandle<VkSampler, vkDestroySampler> handle_;
};

/// Array of sampled images under one binding (`uniform sampler2D textures[]`), of at least one entry. The
/// images and samplers must outlive it.
class TextureArray {
 public:
    struct Entry {
        const Image* image;
        const Sampler* sampler;
    };
    TextureArray() = default;
    /// @throws Error for no entry or more than Device::Limits::textures.
    TextureArray(Device& device, std::span<const Entry> entries);

    VkDescriptorSet set() const { return set_; }

 private:
    UniqueHandle<VkDescriptorPool, vkDestroyDescriptorPool> pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace voxray
