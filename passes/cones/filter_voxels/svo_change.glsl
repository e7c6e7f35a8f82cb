// Which nodes of an octree have a new value: a bit each. What has none need not be filtered again.
#include "passes/cones/radiance/radiance_svo.glsl"

buffer Changed { uint bits[]; } changed;

// Stores a node's value; the node has changed where its bits have.
void replaceOctreeValue(uint node, uint face, vec4 value) {
    const uint at = octreeValueIndex(node, face);
    const uvec2 packed = packRadiance(value);
    if (radianceVoxels.values.data[at] == packed) return;
    radianceVoxels.values.data[at] = packed;
    atomicOr(changed.bits[node / 32u], 1u << (node & 31u));
}

// Whether any of `count` nodes (1 to 8) from `first` on has changed.
bool anyChanged(uint first, uint count) {
    const uint shift = first & 31u, mask = (1u << count) - 1u;
    const uint low = changed.bits[first / 32u] >> shift & mask;
    const uint high = shift + count > 32u ? changed.bits[first / 32u + 1u] & mask >> (32u - shift) : 0u;
    return (low | high) != 0u;
}
