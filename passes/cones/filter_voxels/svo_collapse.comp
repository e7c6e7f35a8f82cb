// Copies a level of an octree and its values to a smaller octree without the descendants of uniform nodes: first the
// masks of the level's nodes (MASKS), then their words, their values and a list of their children (WORDS), four nodes
// of the new octree per thread. `nodes`: for each of them its number in the old octree and its voxel.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_svo.glsl"
layout(local_size_x = 64) in;

readonly buffer Nodes { uvec2 data[]; } nodes;
readonly buffer Uniform { uint bits[]; } uniform_;
buffer Masks { uint words[]; } masks;
readonly buffer Ranks { uint bits[]; } ranks;
writeonly buffer Children { uvec2 data[]; } children;
layout(scalar) readonly buffer Collapsed {
    OctreeWords table;
    OctreeWords nodes;
    OctreeShape shape;
} collapsed;
layout(scalar) readonly buffer CollapsedValues {
    RadianceGrid grid;
    OctreeValues values;
} collapsedValues;
layout(push_constant) uniform Push {
    uint level;
    uint count;  // Nodes of the level in the new octree.
    uint firstNode;
    uint firstChild;
} push;

uint maskOf(uint old) {
    if (push.level == 0u || (uniform_.bits[old / 32u] >> (old & 31u) & 1u) != 0u) return 0u;
    return octreeMask(octree.nodes.data[old]);
}

#ifdef MASKS
void main() {
    const uint word = linearIndex();
    uint mask = 0u;
    for (uint i = 4u * word; i < min(4u * word + 4u, push.count); ++i)
        mask |= maskOf(nodes.data[i].x) << (8u * (i & 3u));
    if (4u * word < push.count) masks.words[word] = mask;
}
#else
void main() {
    const uint word = linearIndex();
    uint child = push.level > 0u && 4u * word < push.count ? ranks.bits[word] : 0u;
    for (uint i = 4u * word; i < min(4u * word + 4u, push.count); ++i) {
        const uint old = nodes.data[i].x, number = push.firstNode + i;
        for (uint face = 0u; face < collapsedValues.grid.directions; ++face)
            collapsedValues.values.data[face * collapsed.shape.nodeCount + number] =
                radianceVoxels.values.data[octreeValueIndex(old, face)];
        if (push.level == 0u) continue;

        const ivec3 cell = unpackCell(nodes.data[i].y);
        const uint mask = maskOf(old);
        const uint node = mask != 0u ? mask | (push.firstChild + child) << 8 : number << 8;
        collapsed.nodes.data[number] = node;
        if (push.level >= collapsed.shape.tableLevel) {
            const uvec3 size = uvec3(octreeSize(push.level) + 2), entry = uvec3(cell + 1);
            collapsed.table.data[collapsed.shape.tableFirst[push.level - collapsed.shape.tableLevel] +
                                 (entry.z * size.y + entry.y) * size.x + entry.x] = node;
        }
        for (uint bits = mask; bits != 0u; bits &= bits - 1u) {
            const uint octant = findLSB(bits);
            const uint oldChild = octreeChild(octree.nodes.data[old], octant);
            children.data[child++] = uvec2(oldChild, packCell(2 * cell + octantOffset(octant)));
        }
    }
}
#endif
