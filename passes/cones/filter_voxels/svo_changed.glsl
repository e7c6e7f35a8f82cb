// Change flags of octree nodes, a bit each: only parents of changed nodes are filtered again.
#include "passes/cones/radiance/radiance_svo.glsl"

buffer Changed { uint bits[]; } changed;

// Stores a node's value, and flags the node if its bits changed.
void replaceOctreeValue(uint node, uint face, vec4 value) {
    const uint index = octreeValueIndex(node, face);
    const uvec2 packed = packRadiance(value);
    if (radianceVoxels.values.data[index] == packed) return;
    radianceVoxels.values.data[index] = packed;
    atomicOr(changed.bits[node / 32u], 1u << (node & 31u));
}

// Whether any of `count` nodes (1 to 8) from `first` on has changed.
bool anyChanged(uint first, uint count) {
    const uint shift = first & 31u, mask = (1u << count) - 1u;
    const uint low = changed.bits[first / 32u] >> shift & mask;
    const uint high = shift + count > 32u ? changed.bits[first / 32u + 1u] & mask >> (32u - shift) : 0u;
    return (low | high) != 0u;
}
