#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "vulkan/commands.h"

/// The state of a CommandStream. Internal to the vulkan layer.
namespace voxray {

struct CommandStream::Impl {
    explicit Impl(Device& device);
    ~Impl();

    /// The command buffer in recording state, after a full barrier.
    VkCommandBuffer recordAfterBarrier();
    /// The command buffer in recording state.
    VkCommandBuffer beginRecording();
    void finish();
    void discard();

    /// Binds a program, its descriptors and its push constants.
    /// @throws Error naming program and binding if one is missing, unknown or of the wrong kind.
    void bind(VkCommandBuffer commands, const Program& program, std::span<const Binding> bindings);

    /// Data in a staging buffer.
    struct Staged {
        const Buffer* buffer;
        uint64_t offset;
    };
    /// Copies data into a staging buffer that lives until finish().
    Staged stage(std::span<const std::byte> data);

    Device& device;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    bool recording = false;
    std::vector<std::string> labels;  ///< Open ones, outermost first.
    Buffer smallUploads;              ///< Persistent staging buffer of small uploads.
    Buffer smallReads;                ///< Persistent staging buffer of small reads from unmapped memory.
    uint64_t smallUploadBytes = 0;    ///< Pending in smallUploads.
    std::vector<Buffer> staging;
    uint64_t stagingBytes = 0;
    StreamCounts counts;
    std::vector<VkQueryPool> queryPools;
    uint32_t timestamps = 0;
    std::vector<std::chrono::steady_clock::time_point> hostTimestamps;  ///< Without Vulkan.
    PFN_vkCmdPushDescriptorSetKHR pushDescriptors = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;
};

/// Orders all later commands after all earlier ones.
void fullBarrier(VkCommandBuffer commands);

}  // namespace voxray
