#pragma once

#include <algorithm>
#include <cstdint>

namespace voxray {

/// Bytes of so many uints, at least one: no buffer is empty.
inline uint64_t uintBytes(uint64_t count) {
    return std::max<uint64_t>(count, 1) * sizeof(uint32_t);
}

}  // namespace voxray
