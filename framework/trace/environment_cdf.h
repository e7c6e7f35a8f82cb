#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace voxray {

/// Distribution of an environment map's texels by luminance times solid angle: rows, then the columns of a row
/// (PBRT 12.5). Texels count with their bilinear patch, so that each has a positive probability wherever its
/// radiance is positive.
struct EnvironmentCdf {
    uint32_t width = 0, height = 0;  ///< 0 without a map, or for a black one.
    std::vector<float> rows;         ///< Probability of this and all previous rows.
    std::vector<float> columns;      ///< By row: probability in the row of this and all previous columns.
    float meanLuminance = 0.0f;      ///< Over all directions, W/(m² sr); also of a constant environment.
};
EnvironmentCdf environmentCdf(const Environment& environment);

/// A texel of a map that repeats horizontally and is clamped vertically; x at least -width.
glm::vec3 environmentTexel(const ImageF& map, int64_t x, int64_t y);

}  // namespace voxray
