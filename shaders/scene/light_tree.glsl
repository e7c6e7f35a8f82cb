// Picks lights from the tree over emissive triangles, point and spot lights by one random number. As LightTree of
// scene/light_tree.h.
#ifndef VOXRAY_LIGHT_TREE_GLSL
#define VOXRAY_LIGHT_TREE_GLSL

#include "shaders/scene/light_tree_types.h"

layout(scalar) readonly buffer SceneLightTree {
    LightTreeNode data[];
}
sceneLightTree;

// Importance of a node's children, which tell more of its lights than its own bounds; of a leaf its own.
float nodeImportance(uint node, vec3 position, vec3 normal) {
    const uint second = sceneLightTree.data[node].link;
    if ((second & LIGHT_TREE_LEAF) != 0u) return lightTreeImportance(sceneLightTree.data[node], position, normal);
    return lightTreeImportance(sceneLightTree.data[node + 1u], position, normal) +
           lightTreeImportance(sceneLightTree.data[second], position, normal);
}

// Picks a light of the subtree of `root` (0: all lights, or GpuScene::emitterRoot) by u in [0, 1). Returns an emitter's
// number, or LIGHT_TREE_PUNCTUAL and a light's. `probability`: 0 where no light reaches a surface with this normal.
uint pickLight(uint root, vec3 position, vec3 normal, float u, out float probability) {
    probability = 1.0;
    uint node = root;
    while ((sceneLightTree.data[node].link & LIGHT_TREE_LEAF) == 0u) {
        const uint second = sceneLightTree.data[node].link;
        const float a = nodeImportance(node + 1u, position, normal);
        const float b = nodeImportance(second, position, normal);
        if (!(a + b > 0.0)) {
            probability = 0.0;
            return 0u;
        }
        const float first = a / (a + b);
        if (u < first) {
            u /= first;
            probability *= first;
            node += 1u;
        } else {
            u = (u - first) / (1.0 - first);
            probability *= b / (a + b);
            node = second;
        }
        u = min(u, 0.99999994);
    }
    return sceneLightTree.data[node].link & ~LIGHT_TREE_LEAF;
}

// Probability that pickLight() finds a leaf (GpuEmitter::leaf).
float lightProbability(uint root, uint leaf, vec3 position, vec3 normal) {
    float probability = 1.0;
    uint node = leaf;
    while (node != root) {
        const uint parent = sceneLightTree.data[node].parent;
        const float a = nodeImportance(parent + 1u, position, normal);
        const float b = nodeImportance(sceneLightTree.data[parent].link, position, normal);
        if (!(a + b > 0.0)) return 0.0;
        probability *= (node == parent + 1u ? a : b) / (a + b);
        node = parent;
    }
    return probability;
}

#endif
