#pragma once

#include <string>
#include <vector>

#include "scene/geometry.h"

namespace voxray {

/// What shines in a scene: one punctual light, all emissive triangles together, or the environment.
struct LightSource {
    enum Kind : uint32_t { Punctual = 0, Emitters = 1, Environment = 2 };  // As shaders have them.
    Kind kind;
    uint32_t light;  ///< Index of a punctual light.
    float power;     ///< W, about: of the brightest colour channel, no less but for textures.
};

/// All sources of light whose power is not 0. A directional light and the environment shine on the disc that
/// the bounding sphere covers.
std::vector<LightSource> lightSources(const SceneState& state);

/// The same. @throws Error naming the pass where there is none.
std::vector<LightSource> requireLightSources(const SceneState& state, const std::string& pass);

/// Area of one side of a triangle, by its vertices, m².
float triangleArea(const Geometry& geometry, glm::uvec3 triangle);

/// Area of one side of all surfaces in the region, m².
double surfaceArea(const Geometry& geometry);

/// W, about, as LightSource::power.
double totalPower(const std::vector<LightSource>& sources);

/// Irradiance of the scene's surfaces, W/m², if each caught its part by area of all power: a scale for sums.
float meanIrradiance(const std::vector<LightSource>& sources, const Geometry& geometry);

/// The power of two below the scene's mean irradiance, 1 without light: a unit of radiance, W/(m² sr), that
/// is in the center of the range of half floats.
float radianceUnit(const SceneState& state);

/// The sphere round the scene's region, a little larger, on which parallel light and the environment shine.
struct BoundingSphere {
    glm::vec3 center;
    float radius;  ///< m
    float reach;   ///< m: as far from the center there are surfaces.
};
BoundingSphere boundingSphere(const Geometry& geometry);

}  // namespace voxray
