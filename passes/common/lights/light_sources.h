#pragma once

#include <string>
#include <vector>

#include "scene/geometry.h"

namespace voxray {

/// A light source: one punctual light, all emissive triangles together, the environment, or the light tree: emissive
/// triangles, point and spot lights together.
struct LightSource {
    enum Kind : uint32_t {
        Punctual = 0,
        Emitters = 1,
        Environment = 2,
        Tree = 3
    };  // As in shaders/lights/lights.glsl.
    Kind kind;
    uint32_t light;  ///< Index of a punctual light.
    float power;     ///< Estimate for the brightest channel, W; an upper bound for untextured emitters.
};

/// All light sources of nonzero power. The power of directional lights and of the environment is that through
/// the disc of the bounding sphere.
std::vector<LightSource> lightSources(const SceneState& state);

/// The same. @throws Error naming the pass if there is none.
std::vector<LightSource> requireLightSources(const SceneState& state, const std::string& pass);

/// Up to so many point and spot lights shadow rays go to each of them; more are sampled (docs/light-sampling.md).
constexpr uint32_t kExactLights = 64;

/// What shadow rays sample: `sources`, but more than `exactLights` point and spot lights are one source together with
/// the emissive triangles.
std::vector<LightSource> shadowRaySources(const std::vector<LightSource>& sources, const SceneState& state,
                                          uint32_t exactLights = kExactLights);

/// Sum of LightSource::power, W.
double totalPower(const std::vector<LightSource>& sources);

/// Total power over surface area, W/m²: the scale of fixed-point sums.
float meanIrradiance(const std::vector<LightSource>& sources, const Geometry& geometry);

/// The power of two below the scene's mean irradiance; 1 without light. As the unit of radiance, W/(m² sr),
/// it centers values in the range of half floats.
float radianceUnit(const SceneState& state);

/// The sphere around the scene's region, slightly enlarged, which parallel light and the environment
/// illuminate.
struct BoundingSphere {
    glm::vec3 center;
    float radius;  ///< m
    float reach;   ///< Maximum distance of surfaces from the center, m.
};
BoundingSphere boundingSphere(const Geometry& geometry);

}  // namespace voxray
