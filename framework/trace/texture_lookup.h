#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scene/geometry.h"

/// Texture lookups on the CPU: level 0, sRGB decoded before filtering (CONVENTIONS 10).
namespace voxray {

/// Linear values of the 256 sRGB codes (IEC 61966-2-1).
extern const std::array<float, 256> kSrgbToLinear;

/// A texel's integer coordinate after wrapping; any `x` that fits in 32 bits, `size` >= 1.
int32_t wrapTexel(int32_t x, int32_t size, Wrap wrap);

/// Lookup by the texture's filter. (0, 0) is the upper left corner of the upper left texel, as in glTF. A
/// coordinate that is not finite reads as 0. The texture has at least one texel.
glm::vec4 sampleTexture(const Texture& texture, glm::vec2 uv);

/// The coordinates with which a material reads a texture: set 0 or 1, then KHR_texture_transform.
inline glm::vec2 textureCoordinates(const TextureRef& ref, const glm::vec4& texCoords) {
    const float u = ref.texCoord == 0 ? texCoords.x : texCoords.z;
    const float v = ref.texCoord == 0 ? texCoords.y : texCoords.w;
    const auto& m = ref.transform;
    return {m[0].x * u + m[0].y * v + m[0].z, m[1].x * u + m[1].y * v + m[1].z};
}

/// Weighted sum of a triangle's three values; `u` and `v` weigh the second and the third.
template <typename T>
T interpolate(const T& a, const T& b, const T& c, float u, float v) {
    return a * (1.0f - u - v) + b * u + c * v;
}

/// Alphas below it are cut away: the material's cutoff, less what rounds off in floats on the way to a
/// product of factor, texture and vertex colour. An alpha equal to the cutoff is opaque.
float alphaThreshold(const Material& material);

/// Whether an alpha-masked surface is cut away at a point of a triangle: base colour's alpha (factor *
/// texture * vertex colour) below the threshold.
bool isCutAway(const SceneState& state, uint32_t triangle, float u, float v);

}  // namespace voxray
