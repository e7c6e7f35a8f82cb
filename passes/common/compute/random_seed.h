#pragma once

#include <cstdint>

#include "graph/pass.h"

namespace voxray {

/// Seed of the random numbers of one of several that a pass draws apart: of a frame, or of a source of light.
/// Derived from the config's seed alone.
inline uint32_t randomSeed(const Frame& frame, uint32_t number = 0) {
    return uint32_t(frame.seed * 0x9e3779b9u) + number * 0x85ebca6bu;
}

}  // namespace voxray
