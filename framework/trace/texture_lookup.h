#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scene/geometry.h"

/// Texture lookups on the CPU: level 0, sRGB decoded before filtering.
namespace voxray {

/// A texel's integer coordinate after wrapping; any `x` that fits in 32 bits, `size` >= 1.
int32_t wrapTexel(int32_t x, int32_t size, Wrap wrap);

/// Samples a texture of at least one texel with its filter. (0, 0) is the upper left corner of the upper left
/// texel, as in glTF. Coordinates that are not finite count as 0.
glm::vec4 sampleTexture(const Texture& texture, glm::vec2 uv);
/// Asks for the memory that sampleTexture() will read.
void prefetchTexels(const Texture& texture, glm::vec2 uv);

/// Texture coordinates of a material: set 0 or 1, then KHR_texture_transform.
inline glm::vec2 textureCoordinates(const TextureRef& ref, const glm::vec4& texCoords) {
    const float u = ref.texCoord == 0 ? texCoords.x : texCoords.z;
    const float v = ref.texCoord == 0 ? texCoords.y : texCoords.w;
    const auto& m = ref.transform;
    return {m[0].x * u + m[0].y * v + m[0].z, m[1].x * u + m[1].y * v + m[1].z};
}

/// Barycentric interpolation; `u` and `v` are the weights of `b` and `c`.
template <typename T>
T interpolate(const T& a, const T& b, const T& c, float u, float v) {
    return a * (1.0f - u - v) + b * u + c * v;
}

/// A material's texture at a point of a triangle.
glm::vec4 sampleTexture(const SceneState& state, const TextureRef& ref, uint32_t triangle, float u, float v);

/// The material's alpha cutoff, less the rounding error of the product of factor, texture and vertex colour:
/// an alpha equal to the cutoff is opaque.
float alphaThreshold(const Material& material);

/// Whether the base colour's alpha (factor * texture * vertex colour) at a point of a triangle is below the
/// threshold.
bool isCutAway(const SceneState& state, uint32_t triangle, float u, float v);

}  // namespace voxray
