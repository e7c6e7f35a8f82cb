#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shaders/scene/light_tree_types.h"

namespace voxray {

/// A light tree's nodes for the host, by their children: four at once are weighed by vector instructions.
class LightTreeGroups {
 public:
    LightTreeGroups() = default;
    /// @param nodes of a tree; the first is its root.
    explicit LightTreeGroups(std::span<const gpu::LightTreeNode> nodes);

    size_t memoryBytes() const {
        return groups_.size() * (sizeof(Group) + sizeof(Kind)) + first_.size() * sizeof(first_[0]);
    }

 private:
    friend class LightTreeWalk;
    static constexpr uint32_t kSize = 4, kNone = 0xffffffffu;
    template <typename T>
    using Each = std::array<T, kSize>;

    /// gpu::LightTreeBounds of children that are next to each other; places that are left over have no intensity.
    /// What lights that face all directions need is in the first two cache lines.
    struct alignas(64) Group {
        std::array<Each<float>, 3> center{}, halfSize{};
        Each<float> intensity{};
        Each<uint32_t> below{kNone, kNone, kNone, kNone};  ///< First group of a child's children; of a leaf kNone.
        std::array<Each<float>, 3> axis{};
        Each<float> cosOrientation{}, sinOrientation{}, cosEmission{};
        Each<uint32_t> doubleSided{};
    };
    /// Of a group; apart, as it is read first.
    struct Kind {
        bool facesAll = true;  ///< Whether all of its children face all directions.
        bool isLast = false;   ///< Of its node.
    };

    static void set(Group& group, uint32_t k, const gpu::LightTreeBounds& bounds);

    std::vector<Group> groups_;
    std::vector<Kind> kinds_;
    std::vector<uint32_t> first_;  ///< Group of each node's children; of a leaf kNone, of a root that is one its own.
};

/// Goes down a light tree at a surface.
class LightTreeWalk {
 public:
    /// Starts at a node; of a leaf the leaf itself is the child. @param normal unit length.
    LightTreeWalk(const LightTreeGroups& tree, uint32_t node, const glm::vec3& position, const glm::vec3& normal)
        : groups_(tree.groups_.data()), kinds_(tree.kinds_.data()), position_(position), normal_(normal) {
        weigh(tree.first_[node], here_);
    }

    using Importances = std::array<float, LIGHT_TREE_MAX_CHILDREN>;
    /// Importance of each child over the intensity of the node, then zeros. A child near the surface counts as its own
    /// children. @return Their sum.
    float importances(Importances& of);
    /// How many importances may be more than 0.
    uint32_t places() const { return here_.count * kSize; }
    /// To a child that is no leaf, after importances().
    void down(uint32_t child);

 private:
    static constexpr uint32_t kSize = LightTreeGroups::kSize, kNone = LightTreeGroups::kNone;
    using Group = LightTreeGroups::Group;
    struct Weighed {
        alignas(16) LightTreeGroups::Each<float> importance;
        alignas(16) LightTreeGroups::Each<uint32_t> isNear;
    };
    /// Of a node, none of whose children counts as its own.
    struct Children {
        uint32_t group, count;  ///< First group of them, and how many groups.
        std::array<Weighed, LIGHT_TREE_MAX_CHILDREN / LightTreeGroups::kSize> of;
    };
    static_assert(LIGHT_TREE_MAX_CHILDREN % LightTreeGroups::kSize == 0 && LIGHT_TREE_MAX_CHILDREN <= 32);

    /// @return Sum of the importances.
    float weigh(uint32_t group, Children& children) const;
    template <bool facesAll>
    void weigh(const Group& group, Weighed& __restrict weighed) const;

    const Group* groups_;
    const LightTreeGroups::Kind* kinds_;
    glm::vec3 position_, normal_;
    Children here_;
    std::array<Children, LIGHT_TREE_MAX_CHILDREN> below_;  ///< Of each child that is near.
    uint32_t isNear_ = 0;                                  ///< A bit for each child.
};

}  // namespace voxray
