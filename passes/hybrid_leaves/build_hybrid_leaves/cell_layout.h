#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "passes/hybrid_leaves/build_hybrid_leaves/cell_sums.h"
#include "passes/hybrid_leaves/hybrid_types.h"
#include "scene/scene.h"

namespace voxray {

/// Words of a cell, and of its sums: more where surfaces emit light or have specular lobes.
struct CellLayout {
    uint32_t words, sumWords;
    float largestEmission;  ///< Over all surfaces and channels, W/(m² sr).
};

inline CellLayout cellLayout(const Scene& scene) {
    float largestEmission = 0;
    bool isExtended = false;
    for (const Material& material : scene.materials) {
        for (int c = 0; c < 3; ++c) largestEmission = std::max(largestEmission, material.emission[c]);
        isExtended |= material.metallic > 0 || material.specular > 0;
    }
    return isExtended || largestEmission > 0 ? CellLayout{EXTENDED_CELL_WORDS, EXTENDED_SUM_UINTS, largestEmission}
                                             : CellLayout{GRID_CELL_WORDS, SUM_UINTS, 0};
}

/// Fixed-point units of area per cell face: sums of that many triangles fit in 31 bits, where each has at
/// most sqrt(2) faces and counts at least one unit. At most 2^20, so that a millionth of a face counts.
inline float unitsPerFace(uint32_t triangles) {
    const double maxUnits = std::ldexp(1.0, 31) / std::max(triangles, 1u) - 1;
    return float(std::exp2(std::clamp(std::floor(std::log2(std::max(maxUnits, 1.0) / 1.5)), 0.0, 20.0)));
}

}  // namespace voxray
