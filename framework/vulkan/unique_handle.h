#pragma once

#include <vulkan/vulkan.h>

#include <utility>

namespace voxray {

/// A Vulkan object that is destroyed with its owner, as in UniqueHandle<VkPipeline, vkDestroyPipeline>.
/// Move-only.
template <typename Handle, auto destroy>
class UniqueHandle {
 public:
    UniqueHandle() = default;
    ~UniqueHandle() {
        if (handle_ != VK_NULL_HANDLE) destroy(device_, handle_, nullptr);
    }
    UniqueHandle(UniqueHandle&& other) noexcept
        : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
    UniqueHandle& operator=(UniqueHandle&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }

    operator Handle() const { return handle_; }
    /// Where a vkCreate function writes the handle. @pre it is empty.
    Handle* receive(VkDevice device) {
        device_ = device;
        return &handle_;
    }

 private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
};

}  // namespace voxray
