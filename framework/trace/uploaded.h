#pragma once

#include <algorithm>
#include <vector>

#include "vulkan/commands.h"
#include "vulkan/device.h"
#include "vulkan/memory.h"

namespace voxray {

/// A device buffer with `data`, of at least one element.
template <typename T>
Buffer uploaded(Device& device, CommandStream& stream, const char* name, const std::vector<T>& data) {
    Buffer buffer(device, name, std::max<uint64_t>(data.size(), 1) * sizeof(T));
    if (!data.empty()) stream.upload(buffer, data);
    return buffer;
}

}  // namespace voxray
