// Filters the values of a level's nodes from those of their children, where any child has changed.
#include "passes/cones/filter_voxels/svo_changed.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_filter.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint firstNode;
    uint count;
} push;

void main() {
    if (linearIndex() >= push.count) return;
    const uint node = push.firstNode + linearIndex(), word = octree.nodes.data[node];
    if (!anyChanged(word >> 8, uint(bitCount(octreeMask(word))))) return;
    const uint directions = radianceVoxels.grid.directions;
    for (uint face = 0u; face < directions; ++face) {
        vec4 child[8];
        for (uint octant = 0u; octant < 8u; ++octant) child[octant] = radianceValue(octreeChild(word, octant), face);
        replaceOctreeValue(node, face, directions == 6u ? combineFaces(child, face) : combineAll(child));
    }
}
