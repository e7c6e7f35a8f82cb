#pragma once

#include <concepts>
#include <string>

#include "vulkan/memory.h"

namespace voxray {

/// A buffer that may outgrow what devices bind at once (128 MiB on software Vulkan): shaders are given its
/// address, in a buffer of its own. GLSL counterpart: shaders/compute/large_buffer.glsl.
class LargeBuffer : public Buffer {
 public:
    LargeBuffer() = default;
    /// As Buffer.
    LargeBuffer(Device& device, const std::string& name, uint64_t bytes)
        : Buffer(device, name, bytes),
          ref_(device, name + "'s address", sizeof(uint64_t), MemoryKind::Upload) {
        ref_.mappedAs<uint64_t>()[0] = address();
    }

    /// What to bind.
    const Buffer& ref() const { return ref_; }

 private:
    Buffer ref_;
};

/// Makes a buffer of so many bytes, or keeps the one that is there where it has as many; another one goes
/// first. Its content is undefined.
template <std::derived_from<Buffer> T>
void ensureSize(T& buffer, Device& device, const std::string& name, uint64_t bytes) {
    if (buffer && buffer.bytes() == bytes) return;
    buffer = {};
    buffer = T(device, name, bytes);
}

}  // namespace voxray
