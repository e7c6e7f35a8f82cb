#pragma once

#include "passes/common/compute/large_buffer.h"

namespace voxray {

/// Fragments of triangles, one word per fragment in each array (Arnebäck 2017, listing 1).
struct FragmentList {
    uint32_t count = 0;
    LargeBuffer cells;    ///< Voxel, 10 bits per axis.
    LargeBuffer colors;   ///< Diffuse albedo, RGBA8.
    LargeBuffer normals;  ///< 0.5 n + 0.5 of the front-side normal n, RGBA8.
};

}  // namespace voxray
