#pragma once

#include <cstdint>

#include "graph/pass.h"

namespace voxray {

/// Seed of one of a pass's independent random sequences, `number`: one per frame, or per light source.
/// Derived from the config's seed alone.
inline uint32_t randomSeed(const Frame& frame, uint32_t number = 0) {
    return uint32_t(frame.seed * 0x9e3779b9u) + number * 0x85ebca6bu;
}

}  // namespace voxray
