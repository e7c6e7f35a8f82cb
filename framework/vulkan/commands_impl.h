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

    /// The command buffer, recording, after a full barrier.
    VkCommandBuffer next();
    /// The command buffer, recording, without a barrier.
    VkCommandBuffer open();
    void finish();
    void discard();

    /// Binds a program with what its shaders name.
    /// @throws Error naming program and binding where one is missing, unknown or of the wrong kind.
    void bind(VkCommandBuffer commands, const Program& program, std::span<const Binding> bindings);

    /// Where data waits for its upload.
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
    Buffer smallUploads;              ///< Kept, for uploads of few bytes.
    Buffer smallReads;              ///< Kept, for reading few bytes back from memory that the host can't see.
    uint64_t smallUploadBytes = 0;  ///< Waiting in smallUploads.
    std::vector<Buffer> staging;
    uint64_t stagingBytes = 0;
    StreamCounts counts;
    std::vector<VkQueryPool> queryPools;
    uint32_t timestamps = 0;
    std::vector<std::chrono::steady_clock::time_point> hostTimestamps;  ///< Where there is no Vulkan.
    PFN_vkCmdPushDescriptorSetKHR pushDescriptors = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;
};

/// Orders everything after everything before.
void fullBarrier(VkCommandBuffer commands);

}  // namespace voxray
