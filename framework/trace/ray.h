#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace voxray {

/// A ray of a stream; 32 bytes, as in GLSL. `direction` need not be unit length: t is in multiples of it. A
/// ray with tMax < tMin is inactive: a miss, and not occluded.
struct Ray {
    glm::vec3 origin;
    float tMin;
    glm::vec3 direction;
    float tMax;
};
static_assert(sizeof(Ray) == 32);

/// The closest hit of a ray; 16 bytes, as in GLSL.
struct Hit {
    static constexpr uint32_t kMiss = 0xffffffffu;
    float t;            ///< Distance in multiples of the ray's direction; the ray's tMax on a miss.
    uint32_t triangle;  ///< Index into Geometry::triangles, or kMiss.
    float u;            ///< Barycentric weight of the triangle's second vertex.
    float v;            ///< Barycentric weight of the triangle's third vertex.
};
static_assert(sizeof(Hit) == 16);

/// Whether adjacent rays of a stream have similar origins and directions, as camera rays have. Affects only
/// speed, and which of several triangles at the same distance is hit.
enum class Coherence { Incoherent, Coherent };

}  // namespace voxray
