#pragma once

#include <vector>

#include "passes/cones/radiance/cone_types.h"

namespace voxray {

/// Cones that divide up the hemisphere over a surface, in rings round its normal. Weights are exact: each
/// cone stands for a stratum of its ring, and weighs as the stratum's cosine-weighted solid angle does.
/// @param count one of coneSetSizes().
std::vector<gpu::Cone> coneSet(uint32_t count);

/// How many cones a set can have; the set of 6 is that of Arnebäck 2017, section 3.2.5.
constexpr std::vector<uint32_t> coneSetSizes() {
    return {5, 6, 16, 36};
}

}  // namespace voxray
