#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "passes/path_trace/environment_light.h"
#include "passes/path_trace/sampling.h"
#include "passes/path_trace/surfaces.h"
#include "scene/geometry.h"

namespace voxray::path_trace {

/// Light that could reach a point, before visibility.
struct LightSample {
    glm::vec3 direction{0.0f};  ///< Unit length, towards the light.
    glm::vec3 target{0.0f};     ///< Where a shadow ray ends, unless infinitely far.
    bool isInfinite = false;
    bool isDelta = false;      ///< No other technique meets this light.
    glm::vec3 radiance{0.0f};  ///< Times solid angle where the light is a delta.
    float pdf = 0.0f;          ///< Per steradian, or the choice's probability alone for a delta; 0: no light.
};

/// All lights of a scene, drawn in proportion to their power.
class LightTable {
 public:
    /// Tells `surfaces` which triangles are lights. Both arguments must outlive this object.
    LightTable(const SceneState& state, SurfaceTable& surfaces);

    bool empty() const { return choice_.empty(); }
    /// Whether a path can meet a light by chance: emissive surfaces or an environment.
    bool canBeHit() const { return !patches_.empty() || !environment_.isBlack(); }
    const EnvironmentLight& environment() const { return environment_; }

    /// Whether there is nothing to choose: any `choice` draws the same light.
    bool isSingle() const { return single_; }

    /// Draws a light by `choice` in [0, 1) and a point on it by `place` in [0, 1)².
    LightSample sample(const glm::vec3& from, float choice, glm::vec2 place) const;

    /// Density per steradian with which `sample` would have drawn a hit `distance` away along `direction`.
    float pdfOfHit(const SurfaceTriangle& triangle, const glm::vec3& direction, float distance) const;
    float pdfOfEnvironment(const glm::vec3& direction) const;

 private:
    /// An emissive triangle, or two that make a parallelogram of constant emission.
    struct Patch {
        uint32_t triangle = 0;
        bool isParallelogram = false;
        float pdf = 0.0f;  ///< Choice's probability over the area, 1/m².
    };

    LightSample samplePatch(const Patch& patch, const glm::vec3& from, glm::vec2 place) const;
    LightSample samplePunctual(const Light& light, float probability, const glm::vec3& from) const;

    const SceneState* state_;
    const SurfaceTable* surfaces_;
    EnvironmentLight environment_;
    std::vector<Patch> patches_;
    uint32_t environmentChoice_ = 0;  ///< After the punctual lights; the patches follow it.
    AliasTable choice_;
    bool single_ = false;
};

}  // namespace voxray::path_trace
