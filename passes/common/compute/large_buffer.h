#pragma once

#include <concepts>
#include <string>

#include "vulkan/memory.h"

namespace voxray {

/// A buffer that may exceed maxStorageBufferRange (128 MiB on software Vulkan): shaders get its address, in a
/// buffer that is bound in its place. GLSL: shaders/compute/large_buffer.glsl.
class LargeBuffer : public Buffer {
 public:
    LargeBuffer() = default;
    /// As Buffer.
    LargeBuffer(Device& device, const std::string& name, uint64_t bytes)
        : Buffer(device, name, bytes), ref_(device, name + "'s address", sizeof(uint64_t), MemoryKind::Upload) {
        ref_.mappedAs<uint64_t>()[0] = address();
    }

    /// The buffer to bind, which holds the address.
    const Buffer& ref() const { return ref_; }

 private:
    Buffer ref_;
};

/// Allocates a buffer unless it has this size already; frees a buffer of another size first. The content is
/// undefined.
template <std::derived_from<Buffer> T>
void ensureSize(T& buffer, Device& device, const std::string& name, uint64_t bytes) {
    if (buffer && buffer.bytes() == bytes) return;
    buffer = {};
    buffer = T(device, name, bytes);
}

/// Makes a buffer anew where it is too small, and frees the old one first. The content is then undefined. The device
/// must not be using it.
template <std::derived_from<Buffer> T>
void growTo(T& buffer, Device& device, const std::string& name, uint64_t bytes) {
    if (!buffer || buffer.bytes() < bytes) ensureSize(buffer, device, name, bytes);
}

}  // namespace voxray
