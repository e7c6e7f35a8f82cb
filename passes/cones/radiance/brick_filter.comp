// Bricks of a level from those of their children (Arnebäck 2017, section 3.2.4, figures 30 and 31). A thread takes a node. One pass
// for the value in the brick's center, which is whole, one for those on its sides and edges and one for its corners, which are a half,
// a quarter and an eighth of it: the neighbours hold the rest, and transfers add them up.
//
// The kernel is 1/4 1/2 1/4 along each axis. On the brick's sides two neighbours hold the kernel's center, so that each takes half of it:
//
//        children's values, along an axis      0     1     2     3     4
//        value 0 of the brick                 1/4   1/4
//        value 1                                    1/4   1/2   1/4
//        value 2                                                1/4   1/4
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uint firstSides;  // Values on so many sides of the brick, ...
    uint lastSides;   // ... up to so many.
} push;

// The octants, as a mask of eight, whose bricks reach to a place along one axis; `low`: the mask of the lower four.
uint octantsAt(int at, uint low) { return at < 2 ? low : at > 2 ? 0xffu & ~low : 0xffu; }

// A value of the children, `at` 0 to 4 along each axis: of the first of the bricks that share it. `bricked`: children that have one.
vec4 childValue(uint brick[8], uint bricked, ivec3 at) {
    const uint sharing = octantsAt(at.x, 0x55u) & octantsAt(at.y, 0x33u) & octantsAt(at.z, 0x0fu) & bricked;
    if (sharing == 0u) return vec4(0.0);
    const uint octant = uint(findLSB(sharing));
    return brickValue(brick[octant], at - 2 * octantOffset(octant));
}

void main() {
    if (linearIndex() >= nodesOf(push.nodes)) return;
    const BrickNode node = radianceVoxels.nodes.data[levelNode(push.nodes, linearIndex())];
    if (node.brick == NO_BRICK) return;
    uint child[8], bricked = 0u;
    for (uint octant = 0u; octant < 8u; ++octant) {
        child[octant] = radianceVoxels.nodes.data[node.firstChild + octant].brick;
        if (child[octant] != NO_BRICK) bricked |= 1u << octant;
    }
    for (int i = 0; i < int(BRICK_VALUES); ++i) {
        const ivec3 at = ivec3(i % 3, i / 3 % 3, i / 9);
        const bvec3 isSide = notEqual(at, ivec3(1));
        const uint sides = uint(isSide.x) + uint(isSide.y) + uint(isSide.z);
        if (sides < push.firstSides || sides > push.lastSides) continue;
        const ivec3 low = max(2 * at - 1, ivec3(0)), high = min(2 * at + 1, ivec3(4));
        vec4 sum = vec4(0.0);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    const vec3 weight = mix(vec3(0.25), vec3(0.5), equal(ivec3(x, y, z), ivec3(2)));
                    sum += weight.x * weight.y * weight.z * childValue(child, bricked, ivec3(x, y, z));
                }
        storeBrickValue(node.brick, at, sum);
    }
}
