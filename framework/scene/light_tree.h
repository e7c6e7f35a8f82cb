#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/geometry.h"
#include "shaders/scene/light_tree_types.h"

namespace voxray {

/// Where a light is and where it emits: all that a light tree needs.
struct BoundedLight {
    uint32_t id = 0;  ///< At most LIGHT_TREE_LEAF - 1; the tree picks it.
    Box bounds;
    double intensity = 0;  ///< Radiant intensity along the axis, luminance, W/sr; more than 0.
    glm::vec3 axis{0, 0, 1};
    float cosOrientation = 1;  ///< Half angle of a cone round the axis that has the directions it faces.
    float cosEmission = 0;     ///< Largest angle from these into which it emits.
    bool doubleSided = false;
};

/// A point or spot light; nothing for a directional or a black one.
std::optional<BoundedLight> boundedLight(const Light& light, uint32_t id);

/// An emissive triangle, or a parallelogram of which it is half. @param corners 3 or 4.
/// @param area m². @param radiance mean luminance, W/(m² sr).
BoundedLight boundedLight(std::span<const glm::vec3> corners, const glm::vec3& normal, double area, double radiance,
                          bool doubleSided, uint32_t id);

/// A binary tree over lights (shaders/scene/light_tree_types.h): picks one for a point at a cost that grows with its
/// depth. Conty Estevez and Kulla 2018; pbrt-v4, section 12.6.3. Equal for equal lights.
class LightTree {
 public:
    struct Pick {
        uint32_t id = 0;
        float probability = 0.0f;  ///< 0: no light reaches the surface.
    };

    LightTree() = default;
    /// @param firstGroup The first so many lights are the root's first child, the others its second; 0, or all: no
    /// groups.
    explicit LightTree(std::span<const BoundedLight> lights, size_t firstGroup = 0);

    bool empty() const { return nodes_.empty(); }
    const std::vector<gpu::LightTreeNode>& nodes() const { return nodes_; }
    /// The node of a light, by its place in the list.
    uint32_t leaf(size_t light) const { return leaves_[light]; }

    /// Estimate of the irradiance of all lights, W/m² of luminance.
    float irradiance(const glm::vec3& position, const glm::vec3& normal) const;
    /// Picks a light. @param u in [0, 1), rescaled at each node. @param normal of the surface, unit length.
    Pick pick(const glm::vec3& position, const glm::vec3& normal, float u) const;
    /// Probability that pick() finds a leaf.
    float probability(uint32_t leaf, const glm::vec3& position, const glm::vec3& normal) const;

 private:
    /// Of a node's children, which tell more of its lights than its own bounds; of a leaf its own.
    float importance(uint32_t node, const glm::vec3& position, const glm::vec3& normal) const;

    double intensity_ = 0;  ///< Of all lights.
    std::vector<gpu::LightTreeNode> nodes_;
    std::vector<uint32_t> leaves_;
};

}  // namespace voxray
