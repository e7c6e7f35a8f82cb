#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "passes/hybrid_leaves/build_hybrid_leaves/cell_sums.h"
#include "passes/hybrid_leaves/hybrid_types.h"
#include "scene/scene.h"

namespace voxray {

/// Words that a cell takes, and that are summed of it: more where surfaces emit light or have specular lobes.
struct CellSize {
    uint32_t words, sums;
    float largestEmission;  ///< W/(m² sr), of all surfaces and channels.
};

inline CellSize cellSize(const Scene& scene) {
    float largest = 0;
    bool isBright = false;
    for (const Material& material : scene.materials) {
        for (int c = 0; c < 3; ++c) largest = std::max(largest, material.emission[c]);
        isBright |= material.metallic > 0 || material.specular > 0;
    }
    return isBright || largest > 0 ? CellSize{BRIGHT_CELL_WORDS, BRIGHT_SUM_UINTS, largest}
                                   : CellSize{GRID_CELL_WORDS, SUM_UINTS, 0};
}

/// Units of area for a cell's face in 31 bits, for a cell of so many triangles: each is at most sqrt(2) faces
/// large there and counts at least one unit. At most 2^20: an area of a millionth of a face still counts.
inline float unitsPerFace(uint32_t triangles) {
    const double room = std::ldexp(1.0, 31) / std::max(triangles, 1u) - 1;
    return float(std::exp2(std::clamp(std::floor(std::log2(std::max(room, 1.0) / 1.5)), 0.0, 20.0)));
}

}  // namespace voxray
