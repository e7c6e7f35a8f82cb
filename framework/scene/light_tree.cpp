#include "scene/light_tree.h"

#include <algorithm>

#include "scene/light_tree_builder.h"

namespace voxray {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1f;

struct Choice {
    uint32_t index;
    float u;  ///< Where in its weight, [0, 1).
};

/// The one of the first `count` weights, not all 0, on which `target` of their sum falls. Without branches: processors
/// would guess half of them wrong.
Choice choose(const LightTreeWalk::Importances& weights, uint32_t count, float target) {
    float sum = 0.0f, before = 0.0f;
    uint32_t index = 0;
    for (uint32_t k = 0; k < count; ++k) {
        sum += weights[k];
        const bool isPassed = sum <= target;
        index += isPassed ? 1 : 0;
        before = isPassed ? sum : before;
    }
    if (index == count) {  // By rounding
        do --index;
        while (!(weights[index] > 0.0f));
        return {index, kBelowOne};
    }
    return {index, std::min((target - before) / weights[index], kBelowOne)};
}

}  // namespace

LightTree::LightTree(std::span<const BoundedLight> lights, size_t firstGroup) {
    for (const BoundedLight& light : lights) intensity_ += light.intensity;
    LightTreeNodes built = buildLightTree(lights, firstGroup);
    nodes_ = std::move(built.nodes);
    leaves_ = std::move(built.leaves);
    groups_ = LightTreeGroups(nodes_);
}

size_t LightTree::memoryBytes() const {
    return nodes_.size() * sizeof(nodes_[0]) + leaves_.size() * sizeof(leaves_[0]) + groups_.memoryBytes();
}

LightTree::Children LightTree::children(uint32_t node) const {
    const uint32_t link = nodes_[node].link;
    if (isLeaf(node)) return {node, 1};
    return {link & LIGHT_TREE_FIRST_CHILD, link >> LIGHT_TREE_COUNT_SHIFT};
}

float LightTree::childrenImportance(uint32_t node, const Receiver& to) const {
    LightTreeWalk::Importances each;
    return LightTreeWalk(groups_, node, to.position, to.normal).importances(each);
}

float LightTree::irradiance(const glm::vec3& position, const glm::vec3& normal) const {
    return empty() ? 0.0f : float(intensity_) * childrenImportance(0, {position, normal});
}

LightTree::Pick LightTree::pick(const Receiver& to, float u) const {
    if (empty()) return {kBeside, to.beside > 0.0f ? 1.0f : 0.0f, u};
    uint32_t node = 0;
    if (isLeaf(node) && !(to.beside > 0.0f)) return {nodes_[node].link & ~LIGHT_TREE_LEAF, 1.0f, u};
    LightTreeWalk walk(groups_, node, to.position, to.normal);
    float ofBeside = beside(to), probability = 1.0f;
    while (true) {
        LightTreeWalk::Importances weights;
        const float total = ofBeside + walk.importances(weights);
        if (!(total > 0.0f)) return {};
        if (u * total < ofBeside) return {kBeside, probability * ofBeside / total, u * total / ofBeside};
        const Choice choice = choose(weights, walk.places(), u * total - ofBeside);
        u = choice.u;
        probability *= weights[choice.index] / total;
        node = children(node).first + choice.index;
        if (isLeaf(node)) return {nodes_[node].link & ~LIGHT_TREE_LEAF, probability, u};
        walk.down(choice.index);
        ofBeside = 0.0f;
    }
}

float LightTree::probability(uint32_t leaf, const Receiver& to) const {
    if (leaf == 0 && !(to.beside > 0.0f)) return 1.0f;
    LightTreeWalk walk(groups_, 0, to.position, to.normal);
    return walkTo(leaf, to, walk);
}

float LightTree::walkTo(uint32_t node, const Receiver& to, LightTreeWalk& walk) const {
    // From the root, as pick() goes: what weighs a near node weighs its children's choice, too
    const uint32_t parent = nodes_[node].parent;
    float ofParent = 1.0f;
    if (parent != 0) {
        ofParent = walkTo(parent, to, walk);
        if (!(ofParent > 0.0f)) return 0.0f;
        walk.down(parent - children(nodes_[parent].parent).first);
    }
    LightTreeWalk::Importances weights;
    const float below = walk.importances(weights), total = parent == 0 ? beside(to) + below : below;
    return total > 0.0f ? ofParent * weights[node - children(parent).first] / total : 0.0f;
}

float LightTree::besideProbability(const Receiver& to) const {
    if (!(to.beside > 0.0f)) return 0.0f;
    return empty() ? 1.0f : beside(to) / (beside(to) + childrenImportance(0, to));
}

}  // namespace voxray
