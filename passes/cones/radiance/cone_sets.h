#pragma once

#include <vector>

#include "passes/cones/radiance/cone_types.h"

namespace voxray {

/// Cones that partition the hemisphere over a surface, in rings around its normal. Each represents a stratum
/// of its ring; its weight is the stratum's cosine-weighted solid angle.
/// @param count one of coneSetSizes().
std::vector<gpu::Cone> coneSet(uint32_t count);

/// Numbers of cones in a set; the set of 6 is that of Arnebäck 2017, section 3.2.5.
constexpr std::vector<uint32_t> coneSetSizes() {
    return {5, 6, 16, 36};
}

}  // namespace voxray
