#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "passes/path_trace/environment_light.h"
#include "passes/path_trace/sampling.h"
#include "passes/path_trace/surfaces.h"
#include "scene/geometry.h"

namespace voxray::path_trace {

/// Unoccluded light at a point.
struct LightSample {
    glm::vec3 direction{0.0f};  ///< Unit length, towards the light.
    glm::vec3 target{0.0f};     ///< Where a shadow ray ends, unless the light is infinite.
    bool isInfinite = false;
    bool isDelta = false;      ///< No other technique samples this light.
    glm::vec3 radiance{0.0f};  ///< Irradiance of a delta light, else radiance.
    float pdf = 0.0f;          ///< Per steradian, or the choice's probability alone for a delta; 0: no light.
};

/// All lights of a scene, sampled in proportion to their power.
class LightTable {
 public:
    /// Marks emissive triangles in `surfaces`. Both arguments must outlive this object.
    LightTable(const SceneState& state, SurfaceTable& surfaces);

    bool empty() const { return distribution_.empty(); }
    /// Whether a path can hit a light: emissive surfaces or an environment.
    bool canBeHit() const { return !patches_.empty() || !environment_.isBlack(); }
    const EnvironmentLight& environment() const { return environment_; }

    /// Whether there is one light only: `uLight` has no effect.
    bool isSingle() const { return isSingle_; }

    /// Samples a light by `uLight` in [0, 1) and a point on it by `u` in [0, 1)².
    LightSample sample(const glm::vec3& from, float uLight, glm::vec2 u) const;

    /// An emissive triangle, or two that form a parallelogram of constant emission: this one and the next.
    struct Patch {
        uint32_t triangle = 0;
        bool isParallelogram = false;
        float pdf = 0.0f;  ///< Selection probability over area, 1/m².
    };
    /// What sample() draws from: punctual lights, the environment, patches.
    const AliasTable& distribution() const { return distribution_; }
    uint32_t environmentIndex() const { return environmentIndex_; }
    std::span<const Patch> patches() const { return patches_; }

    /// Density of sample(), per steradian, for a light hit at `distance` along `direction`.
    float hitPdf(const SurfaceTriangle& triangle, const glm::vec3& direction, float distance) const;
    float environmentPdf(const glm::vec3& direction) const;

 private:
    LightSample samplePatch(const Patch& patch, const glm::vec3& from, glm::vec2 u) const;
    LightSample samplePunctual(const Light& light, float probability, const glm::vec3& from) const;

    const SceneState* state_;
    const SurfaceTable* surfaces_;
    EnvironmentLight environment_;
    std::vector<Patch> patches_;
    uint32_t environmentIndex_ = 0;  ///< In `distribution_`: after the punctual lights, before the patches.
    AliasTable distribution_;
    bool isSingle_ = false;
};

}  // namespace voxray::path_trace
