#pragma once

#include <cstdint>

namespace voxray {

/// PassContext::frameIndex of the first warm-up frame; that of the first measured one is 0.
inline constexpr uint32_t kFirstWarmupFrame = 1000000;

constexpr bool isWarmup(uint32_t frameIndex) {
    return frameIndex >= kFirstWarmupFrame;
}

}  // namespace voxray
