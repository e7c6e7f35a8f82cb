#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/bounded_light.h"
#include "scene/light_tree_groups.h"
#include "shaders/scene/light_tree_types.h"

namespace voxray {

/// The most nodes that a tree over so many lights has: each inner one has two children or more. At least 1.
constexpr uint64_t lightTreeNodes(uint64_t lights) {
    return lights > 0 ? 2 * lights - 1 : 1;
}

/// A tree over lights (shaders/scene/light_tree_types.h): picks one for a point at a cost that grows with its depth.
/// Conty Estevez and Kulla 2018; pbrt-v4, section 12.6.3. Equal for equal lights.
class LightTree {
 public:
    static constexpr uint32_t kBeside = LIGHT_TREE_BESIDE;

    /// A surface that lights are picked for, and the irradiance of lights that are not in the tree, W/m² of luminance.
    struct Receiver {
        glm::vec3 position;
        glm::vec3 normal;  ///< Unit length.
        float beside = 0.0f;
    };
    struct Pick {
        uint32_t id = 0;           ///< kBeside: of the lights beside the tree.
        float probability = 0.0f;  ///< 0: no light reaches the surface.
        float u = 0.0f;            ///< The random number, rescaled to [0, 1).
    };

    LightTree() = default;
    /// @param firstGroup The first so many lights are the root's first child, the others its second; 0, or all: no
    /// groups. @throws Error for more lights than a node can number.
    explicit LightTree(std::span<const BoundedLight> lights, size_t firstGroup = 0);

    bool empty() const { return nodes_.empty(); }
    const std::vector<gpu::LightTreeNode>& nodes() const { return nodes_; }
    /// The node of a light, by its place in the list.
    uint32_t leaf(size_t light) const { return leaves_[light]; }
    /// Of what the host keeps, its nodes included.
    size_t memoryBytes() const;
    /// Of all lights: an importance times this is W/m² of luminance.
    double intensity() const { return intensity_; }

    /// Estimate of the irradiance of all lights, W/m² of luminance.
    float irradiance(const glm::vec3& position, const glm::vec3& normal) const;
    /// Picks a light. @param u in [0, 1).
    Pick pick(const Receiver& to, float u) const;
    /// Probability that pick() finds a leaf.
    float probability(uint32_t leaf, const Receiver& to) const;
    /// Probability that pick() finds the lights beside the tree.
    float besideProbability(const Receiver& to) const;

 private:
    /// First and number of a node's children; of a leaf the leaf itself.
    struct Children {
        uint32_t first, count;
    };
    Children children(uint32_t node) const;
    bool isLeaf(uint32_t node) const { return (nodes_[node].link & LIGHT_TREE_LEAF) != 0; }
    float childrenImportance(uint32_t node, const Receiver& to) const;
    /// Probability of a node. @param walk from the root; ends at the node's parent.
    float walkTo(uint32_t node, const Receiver& to, LightTreeWalk& walk) const;
    /// Receiver::beside as an importance.
    float beside(const Receiver& to) const { return to.beside / float(intensity_); }

    double intensity_ = 0;
    std::vector<gpu::LightTreeNode> nodes_;
    std::vector<uint32_t> leaves_;
    LightTreeGroups groups_;
};

}  // namespace voxray
