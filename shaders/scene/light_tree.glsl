// Picks lights from the tree over emissive triangles, point and spot lights by one random number. As LightTree of
// scene/light_tree.h. LIGHT_TREE is the buffer of its nodes: the scene's, unless a shader names its own.
#ifndef VOXRAY_LIGHT_TREE_GLSL
#define VOXRAY_LIGHT_TREE_GLSL

#include "shaders/scene/light_tree_types.h"

#ifndef LIGHT_TREE
layout(scalar) readonly buffer SceneLightTree {
    LightTreeNode data[];
}
sceneLightTree;
#define LIGHT_TREE sceneLightTree
#endif

// What weighs a node's children; of a leaf the leaf itself.
struct LightTreeChildren {
    uint first;
    uint count;
    vec3 low;  // Bounds of their parent, m.
    vec3 size;
};

bool isLeaf(uint node) { return (LIGHT_TREE.data[node].link & LIGHT_TREE_LEAF) != 0u; }

LightTreeChildren childrenOf(uint node) {
    const uint link = LIGHT_TREE.data[node].link;
    const bool leaf = (link & LIGHT_TREE_LEAF) != 0u;
    return LightTreeChildren(leaf ? node : link & LIGHT_TREE_FIRST_CHILD, leaf ? 1u : link >> LIGHT_TREE_COUNT_SHIFT,
                             LIGHT_TREE.data[node].low, LIGHT_TREE.data[node].size);
}

LightTreeBounds childBounds(LightTreeChildren children, uint k) {
    return lightTreeBounds(LIGHT_TREE.data[children.first + k].summary, children.low, children.size);
}

// Importance of child k; of a node near the point that of its children.
float childImportance(LightTreeChildren children, uint k, vec3 position, vec3 normal) {
    const LightTreeBounds b = childBounds(children, k);
    if (!lightTreeIsNear(b, position) || isLeaf(children.first + k)) return lightTreeImportance(b, position, normal);
    const LightTreeChildren below = childrenOf(children.first + k);
    float total = 0.0;
    for (uint i = 0u; i < below.count; ++i) total += lightTreeImportance(childBounds(below, i), position, normal);
    return b.intensity * total;
}

// Importance of all children of a node.
float childrenImportance(uint node, vec3 position, vec3 normal) {
    const LightTreeChildren children = childrenOf(node);
    float total = 0.0;
    for (uint k = 0u; k < children.count; ++k) total += childImportance(children, k, position, normal);
    return total;
}

// Picks a light of the subtree of `root` (0: all lights, or GpuScene::emitterRoot) by u in [0, 1), which is rescaled.
// Returns an emitter's number, or LIGHT_TREE_PUNCTUAL and a light's, or LIGHT_TREE_BESIDE for lights of importance
// `beside` that are not in the tree. `probability`: 0 where no light reaches a surface with this normal.
uint pickLight(uint root, vec3 position, vec3 normal, float beside, inout float u, out float probability) {
    probability = 1.0;
    uint node = root;
    bool isDone = beside <= 0.0 && isLeaf(root);
    while (!isDone) {
        const LightTreeChildren children = childrenOf(node);
        float importance[LIGHT_TREE_MAX_CHILDREN];
        float total = beside;
        for (uint k = 0u; k < children.count; ++k)
            total += importance[k] = childImportance(children, k, position, normal);
        if (!(total > 0.0)) {
            probability = 0.0;
            return 0u;
        }
        float rest = u * total, ofPicked = beside;
        uint picked = LIGHT_TREE_BESIDE;
        for (uint k = 0u; k < children.count && rest >= ofPicked; ++k) {
            if (!(importance[k] > 0.0)) continue;
            rest -= ofPicked;
            ofPicked = importance[k];
            picked = k;
        }
        u = min(rest / ofPicked, 0.99999994);
        probability *= ofPicked / total;
        if (picked == LIGHT_TREE_BESIDE) return picked;
        beside = 0.0;
        node = children.first + picked;
        isDone = isLeaf(node);
    }
    return LIGHT_TREE.data[node].link & ~LIGHT_TREE_LEAF;
}

// Probability that pickLight() finds a leaf (GpuEmitter::leaf).
float lightProbability(uint root, uint leaf, vec3 position, vec3 normal, float beside) {
    if (leaf == root && beside <= 0.0) return 1.0;
    float probability = 1.0;
    uint node = leaf;
    do {
        const uint parent = node == root ? root : LIGHT_TREE.data[node].parent;
        const LightTreeChildren children = childrenOf(parent);
        float total = parent == root ? max(beside, 0.0) : 0.0, ofNode = 0.0;
        for (uint k = 0u; k < children.count; ++k) {
            const float importance = childImportance(children, k, position, normal);
            total += importance;
            if (children.first + k == node) ofNode = importance;
        }
        if (!(total > 0.0)) return 0.0;
        probability *= ofNode / total;
        node = parent;
    } while (node != root);
    return probability;
}

#endif
