#pragma once

#include <vector>

#include "shaders/radiance/cone_types.h"

namespace voxray {

/// Cones that share out the hemisphere over a surface, in rings round its normal. Weights are exact: each
/// cone stands for a stratum of its ring, and weighs as the stratum's cosine-weighted solid angle does.
/// @param count 5, 6 (Arnebäck 2017, section 3.2.5), 16 or 36. @throws Error for any other, naming `pass` and
/// these.
std::vector<gpu::Cone> coneSet(const char* pass, uint32_t count);

}  // namespace voxray
