#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "passes/path_trace/environment_light.h"
#include "passes/path_trace/sampling.h"
#include "passes/path_trace/surfaces.h"
#include "scene/geometry.h"
#include "scene/light_tree.h"

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

/// All lights of a scene, sampled in proportion to their estimated irradiance at a point: a light tree, beside
/// whose root are directional lights and the environment's map.
class LightTable {
 public:
    /// Marks emissive triangles in `surfaces`. Both arguments must outlive this object.
    LightTable(const SceneState& state, SurfaceTable& surfaces);

    bool empty() const { return tree_.empty() && infinite_.empty(); }
    /// Whether a path can hit a light: emissive surfaces or an environment.
    bool canBeHit() const { return !patches_.empty() || !environment_.isBlack(); }
    const EnvironmentLight& environment() const { return environment_; }

    /// Whether there is one light only: `uLight` has no effect.
    bool isSingle() const { return tree_.nodes().size() + infinite_.size() == 1; }

    /// A surface that lights are sampled for.
    struct Receiver {
        glm::vec3 position;    ///< Of the origin of its rays.
        glm::vec3 faceNormal;  ///< Geometric, unit length; light comes from its side only.
    };

    /// Samples a light by `uLight` in [0, 1) and a point on it by `u` in [0, 1)².
    LightSample sample(const Receiver& to, float uLight, glm::vec2 u) const;

    /// Density of sample(), per steradian, for a light hit at `distance` along `direction`.
    float hitPdf(const Receiver& to, const SurfaceTriangle& triangle, const glm::vec3& direction, float distance) const;
    float environmentPdf(const Receiver& to, const glm::vec3& direction) const;

    /// An emissive triangle, or two that form a parallelogram of constant emission: this one and the next.
    struct Patch {
        uint32_t triangle = 0;
        bool isParallelogram = false;
        float inverseArea = 0.0f;  ///< 1/m²
        uint32_t leaf = kNoLeaf;   ///< Of the tree.
    };
    static constexpr uint32_t kNoLeaf = 0xffffffffu;
    static constexpr uint32_t kEnvironment = 0xffffffffu;

    /// What sample() draws from: the tree of point and spot lights by index, then patches (pick, less the number of
    /// lights); and beside it directional lights by index, and kEnvironment.
    const LightTree& tree() const { return tree_; }
    std::span<const Patch> patches() const { return patches_; }
    std::span<const uint32_t> infinite() const { return infinite_; }
    /// Estimated irradiance of the environment's map, as a choice weighs it.
    float environmentIrradiance() const;

 private:
    /// Number of a patch in the tree; a smaller one is that of a punctual light.
    uint32_t idOf(size_t patch) const { return uint32_t(state_->lights.size() + patch); }
    /// Finds emissive triangles. @return those for the tree.
    std::vector<BoundedLight> addPatches();

    LightSample samplePatch(const Patch& patch, float probability, const glm::vec3& from, glm::vec2 u) const;
    LightSample samplePunctual(const Light& light, float probability, const glm::vec3& from) const;
    LightSample sampleInfinite(const Receiver& to, const LightTree::Pick& pick, glm::vec2 u) const;
    LightSample sampleEnvironment(float probability, glm::vec2 u) const;

    /// Estimated irradiance of an infinite light.
    float irradiance(uint32_t infinite, const Receiver& to) const;
    /// The same of all infinite lights.
    float infiniteIrradiance(const Receiver& to) const;
    LightTree::Receiver treeReceiver(const Receiver& to) const {
        return {to.position, to.faceNormal, infiniteIrradiance(to)};
    }

    const SceneState* state_;
    SurfaceTable* surfaces_;
    EnvironmentLight environment_;
    std::vector<Patch> patches_;
    LightTree tree_;                  ///< Point and spot lights by index, then patches.
    std::vector<uint32_t> infinite_;  ///< Directional lights by index, and kEnvironment.
};

}  // namespace voxray::path_trace
