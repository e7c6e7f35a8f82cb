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
          at_(device, name + "'s address", sizeof(uint64_t), MemoryKind::Upload) {
        at_.mappedAs<uint64_t>()[0] = address();
    }

    /// What to bind.
    const Buffer& at() const { return at_; }

 private:
    Buffer at_;
};

/// Makes a buffer of so many bytes, or keeps the one that is there where it has as many; another one goes
/// first. Its content is undefined.
template <std::derived_from<Buffer> T>
void makeOrKeep(T& buffer, Device& device, const std::string& name, uint64_t bytes) {
    if (buffer && buffer.bytes() == bytes) return;
    buffer = {};
    buffer = T(device, name, bytes);
}

}  // namespace voxray
