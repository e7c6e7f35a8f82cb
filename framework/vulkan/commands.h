#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vulkan/binding.h"
#include "vulkan/device.h"
#include "vulkan/memory.h"
#include "vulkan/program.h"

namespace voxray {

/// Targets of a raster pass. All have at least the extent of the viewport.
struct RasterTargets {
    struct Color {
        const Image* image;
        std::optional<VkClearColorValue> clear;  ///< Empty: keep the content.
    };
    std::vector<Color> colors;
    const Image* depth = nullptr;
    float depthClear = 1;
    glm::uvec3 extent{0, 0, 1};  ///< Viewport, from (0, 0); also what is rendered where there are no targets.
};

/// What a stream has done so far.
struct StreamCounts {
    uint64_t dispatches = 0;  ///< Compute, raster and ray calls and builds of acceleration structures.
    uint64_t waits = 0;       ///< Submissions whose end the host waited for.
    uint64_t hostBytes = 0;   ///< Of upload() and read(): copied from the host or to it.

    StreamCounts operator-(const StreamCounts& earlier) const {
        return {dispatches - earlier.dispatches, waits - earlier.waits, hostBytes - earlier.hostBytes};
    }
};

/// Records commands and runs them. Each call is ordered after all calls before it (a full memory barrier
/// between them), so passes need no barriers of their own. Every binding that the program reflects must be
/// given, and no other; programs and resources must outlive finish(). What was recorded but not finished is
/// dropped with the stream.
/// @throws Error naming the program and the binding.
class CommandStream {
 public:
    explicit CommandStream(Device& device);
    ~CommandStream();
    CommandStream(const CommandStream&) = delete;
    CommandStream& operator=(const CommandStream&) = delete;

    Device& device();

    /// Runs a compute program. No invocations record nothing.
    /// @throws Error naming program and member for a push constant that is not given, or of another type or
    /// size; and naming what is given without a use.
    void dispatch(const Program& program, const Invocations& invocations, const Bindings& bindings);
    /// Draws `vertexCount` vertices, `instanceCount` times.
    void draw(const Program& program, const RasterTargets& targets, uint32_t vertexCount,
              const Bindings& bindings, uint32_t instanceCount = 1);

    void fill(const Buffer& buffer, uint32_t word);           ///< The whole buffer.
    void clear(const Image& image, VkClearColorValue value);  ///< All levels.
    void copy(const Buffer& from, const Buffer& to, uint64_t bytes, uint64_t fromOffset = 0,
              uint64_t toOffset = 0);
    void copy(const Image& from, const Buffer& to, uint32_t level = 0);  ///< One level, tightly packed.
    void copy(const Buffer& from, const Image& to, uint32_t level = 0);
    /// Filters level 0 down by linear blits: a box filter where extents are even. 2D and 3D.
    /// @throws Error for a format without linear blits.
    void makeMipLevels(const Image& image);

    /// Host data into a device buffer, through staging buffers that live until finish(); more than 64 MiB of
    /// them are not kept: the stream then submits and waits.
    void upload(const Buffer& to, std::span<const std::byte> data, uint64_t toOffset = 0);
    template <typename T>
    void upload(const Buffer& to, const std::vector<T>& data) {
        upload(to, std::as_bytes(std::span(data)));
    }

    /// Host texels, tightly packed, into one level of an image.
    void upload(const Image& to, std::span<const std::byte> data, uint32_t level = 0);

    /// Records raw commands (acceleration structures) between barriers.
    void record(const std::function<void(VkCommandBuffer)>& commands);
    /// The same with a program and its bindings bound first (vkCmdTraceRaysKHR).
    void record(const Program& program, const Bindings& bindings,
                const std::function<void(VkCommandBuffer)>& commands);

    /// Names what follows in captures, until the matching end.
    void beginLabel(const std::string& name);
    void endLabel();

    /// A time stamp on the device once all earlier work is done; the index is valid until resetTimestamps().
    uint32_t timestamp();
    /// Milliseconds between two stamps, after finish(). Includes host work done in between by the Embree
    /// backend.
    double millisecondsBetween(uint32_t first, uint32_t second) const;
    void resetTimestamps();

    /// Submits what was recorded and waits; the stream then records again.
    void finish();

    /// Drops what was recorded since the last finish(), open labels and time stamps with it: after an error,
    /// when resources that the commands name may be gone already.
    void discard();

    /// Of all that was recorded since the stream was made. Dispatches without work groups do not count.
    const StreamCounts& counts() const;

    /// Bytes of the staging buffers that wait for finish().
    uint64_t stagingBytes() const;

    /// finish(), then the bytes of a buffer (staged where it isn't mapped).
    std::vector<std::byte> read(const Buffer& buffer, uint64_t bytes, uint64_t offset = 0);
    template <typename T>
    std::vector<T> readAs(const Buffer& buffer, size_t count) {
        const std::vector<std::byte> raw = read(buffer, count * sizeof(T));
        std::vector<T> out(count);
        std::memcpy(out.data(), raw.data(), raw.size());
        return out;
    }

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace voxray
