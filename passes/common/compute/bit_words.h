#pragma once

#include <cstdint>

namespace voxray {

/// 32-bit words that hold so many bits.
constexpr uint64_t bitWords(uint64_t bits) {
    return (bits + 31) / 32;
}

}  // namespace voxray
