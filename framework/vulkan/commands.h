#pragma once

#include <vulkan/vulkan.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vulkan/binding.h"
#include "vulkan/device.h"
#include "vulkan/memory.h"
#include "vulkan/program.h"
#include "vulkan/unique_handle.h"

namespace voxray {

/// Targets of a raster pass. All have at least the extent of the viewport.
struct RasterTargets {
    struct Color {
        const Image* image;
        std::optional<VkClearColorValue> clear;  ///< Empty: keep the contents.
    };
    std::vector<Color> colors;
    const Image* depth = nullptr;
    float depthClear = 1;
    glm::uvec3 extent{0, 0, 1};  ///< Viewport, from (0, 0); the rendered area if there are no targets.
    /// Viewports within `extent`, each from (0, 0), for a program with as many (RasterState::viewports); empty: one.
    std::vector<glm::uvec2> viewports;
};

/// Counts of a stream's operations.
struct StreamCounts {
    uint64_t dispatches = 0;  ///< Compute, raster and ray calls and builds of acceleration structures.
    uint64_t waits = 0;       ///< Submissions that the host waited for.
    uint64_t hostBytes = 0;   ///< Bytes copied by upload() and read().

    StreamCounts operator-(const StreamCounts& earlier) const {
        return {dispatches - earlier.dispatches, waits - earlier.waits, hostBytes - earlier.hostBytes};
    }
};

/// Records and submits commands, with a full memory barrier between calls. A call must give exactly the
/// bindings that its program declares; programs and resources must outlive finish(). The destructor drops
/// unfinished commands.
/// @throws Error naming the program and the binding.
class CommandStream {
 public:
    explicit CommandStream(Device& device);
    CommandStream(const CommandStream&) = delete;
    CommandStream& operator=(const CommandStream&) = delete;

    Device& device() { return device_; }

    /// Dispatches a compute program; nothing for 0 invocations.
    /// @throws Error naming program and member for a push constant that is missing or has another type or
    /// size, for a binding that the program doesn't declare, and for a number of elements where the program's
    /// work groups have more than one axis.
    void dispatch(const Program& program, const Invocations& invocations, const Bindings& bindings);
    /// Draws `vertexCount` vertices, `instanceCount` times.
    void draw(const Program& program, const RasterTargets& targets, uint32_t vertexCount, const Bindings& bindings,
              uint32_t instanceCount = 1);

    void fill(const Buffer& buffer, uint32_t word);           ///< The whole buffer.
    void clear(const Image& image, VkClearColorValue value);  ///< All levels.
    void copy(const Buffer& from, const Buffer& to, uint64_t bytes, uint64_t fromOffset = 0, uint64_t toOffset = 0);
    void copy(const Image& from, const Buffer& to, uint32_t level = 0);  ///< One level, tightly packed.
    void copy(const Buffer& from, const Image& to, uint32_t level = 0);
    /// Generates mip levels by linear blits: a box filter where extents are even. 2D and 3D.
    /// @throws Error for a format without linear blits.
    void makeMipLevels(const Image& image);

    /// Copies host data to a buffer, through staging buffers that live until finish(). Beyond 64 MiB of them
    /// the stream submits and waits.
    void upload(const Buffer& to, std::span<const std::byte> data, uint64_t toOffset = 0);
    template <typename T>
    void upload(const Buffer& to, const std::vector<T>& data) {
        upload(to, std::as_bytes(std::span(data)));
    }

    /// Copies host texels, tightly packed, to one level of an image.
    void upload(const Image& to, std::span<const std::byte> data, uint32_t level = 0);

    /// Records Vulkan commands (of acceleration structures) between barriers.
    void record(const std::function<void(VkCommandBuffer)>& commands);
    /// The same with a program and its bindings bound first (vkCmdTraceRaysKHR).
    void record(const Program& program, const Bindings& bindings, const std::function<void(VkCommandBuffer)>& commands);

    /// Labels the following commands in captures, until the matching end.
    void beginLabel(const std::string& name);
    void endLabel();

    /// Writes a timestamp when all earlier commands are done. @return its index, valid until
    /// resetTimestamps().
    uint32_t timestamp();
    /// Milliseconds between two timestamps, after finish(), including host work of the Embree backend.
    double millisecondsBetween(uint32_t first, uint32_t second) const;
    void resetTimestamps() { timestamps_ = 0; }

    /// Submits recorded commands and waits.
    void finish();

    /// Drops commands, open labels and timestamps since the last finish(): after an error, when resources of
    /// the commands may have been destroyed.
    void discard();

    /// Since the stream was created. Dispatches without work groups do not count.
    const StreamCounts& counts() const { return counts_; }

    /// Bytes of staging buffers that finish() will free.
    uint64_t stagingBytes() const { return stagingBytes_; }

    /// Calls finish(), then returns the bytes of a buffer (staged if it isn't mapped).
    std::vector<std::byte> read(const Buffer& buffer, uint64_t bytes, uint64_t offset = 0);
    template <typename T>
    std::vector<T> readAs(const Buffer& buffer, size_t count) {
        const std::vector<std::byte> raw = read(buffer, count * sizeof(T));
        std::vector<T> out(count);
        std::memcpy(out.data(), raw.data(), raw.size());
        return out;
    }

 private:
    /// The command buffer in recording state.
    VkCommandBuffer beginRecording();
    /// The same, after a full barrier.
    VkCommandBuffer recordAfterBarrier();
    /// Binds a program, its descriptors and its push constants (bind.cpp).
    /// @throws Error naming program and binding if one is missing, unknown or of the wrong kind.
    void bind(VkCommandBuffer commands, const Program& program, std::span<const Binding> bindings);
    /// Data in a staging buffer.
    struct Staged {
        const Buffer* buffer;
        uint64_t offset;
    };
    /// Copies data into a staging buffer that lives until finish().
    Staged stage(std::span<const std::byte> data);

    Device& device_;
    UniqueHandle<VkCommandPool, vkDestroyCommandPool> pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    UniqueHandle<VkFence, vkDestroyFence> fence_;
    bool isRecording_ = false;
    std::vector<std::string> labels_;  ///< Open ones, outermost first.
    Buffer smallUploads_;              ///< Persistent staging buffer of small uploads.
    Buffer smallReads_;                ///< Persistent staging buffer of small reads from unmapped memory.
    uint64_t smallUploadBytes_ = 0;    ///< Pending in smallUploads_.
    std::vector<Buffer> staging_;
    uint64_t stagingBytes_ = 0;
    StreamCounts counts_;
    std::vector<UniqueHandle<VkQueryPool, vkDestroyQueryPool>> queryPools_;
    uint32_t timestamps_ = 0;
    std::vector<std::chrono::steady_clock::time_point> hostTimestamps_;  ///< Without Vulkan.
    PFN_vkCmdPushDescriptorSetKHR pushDescriptors_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel_ = nullptr;
};

}  // namespace voxray
