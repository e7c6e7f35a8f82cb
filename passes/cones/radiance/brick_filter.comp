// Bricks of a level from those of their children (Arnebäck 2017, section 3.2.4, figures 30 and 31), in three
// dispatches: the value in the brick's center; those on its faces and edges; those at its corners. Values on faces,
// edges and corners are partial sums over a half, a quarter and an eighth of the kernel, to which transfers add those
// of the neighbors.
//
// The kernel is 1/4 1/2 1/4 along each axis. On a face two neighbors share the kernel's center, so that each has half
// of it:
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
    uint minFaces;  // Filters values that are on at least so many faces of the brick, ...
    uint maxFaces;  // ... and at most so many.
} push;

// Mask of the octants whose bricks contain a texel coordinate (0 to 4) along one axis; `low`: mask of the lower four.
uint octantsAt(int texel, uint low) { return texel < 2 ? low : texel > 2 ? 0xffu & ~low : 0xffu; }

// The children's value at a texel, 0 to 4 along each axis, from the first of the bricks that share it. `present`:
// children with bricks.
vec4 childValue(uint brick[8], uint present, ivec3 texel) {
    const uint sharing = octantsAt(texel.x, 0x55u) & octantsAt(texel.y, 0x33u) & octantsAt(texel.z, 0x0fu) & present;
    if (sharing == 0u) return vec4(0.0);
    const uint octant = uint(findLSB(sharing));
    return brickValue(brick[octant], texel - 2 * octantOffset(octant));
}

void main() {
    if (linearIndex() >= nodesOf(push.nodes)) return;
    const BrickNode node = radianceVoxels.nodes.data[levelNode(push.nodes, linearIndex())];
    if (node.brick == NO_BRICK) return;
    uint child[8], present = 0u;
    for (uint octant = 0u; octant < 8u; ++octant) {
        child[octant] = radianceVoxels.nodes.data[node.firstChild + octant].brick;
        if (child[octant] != NO_BRICK) present |= 1u << octant;
    }
    for (int i = 0; i < int(BRICK_VALUES); ++i) {
        const ivec3 texel = ivec3(i % 3, i / 3 % 3, i / 9);
        const bvec3 isOnFace = notEqual(texel, ivec3(1));
        const uint faces = uint(isOnFace.x) + uint(isOnFace.y) + uint(isOnFace.z);
        if (faces < push.minFaces || faces > push.maxFaces) continue;
        const ivec3 low = max(2 * texel - 1, ivec3(0)), high = min(2 * texel + 1, ivec3(4));
        vec4 sum = vec4(0.0);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    const vec3 weight = mix(vec3(0.25), vec3(0.5), equal(ivec3(x, y, z), ivec3(2)));
                    sum += weight.x * weight.y * weight.z * childValue(child, present, ivec3(x, y, z));
                }
        storeBrickValue(node.brick, texel, sum);
    }
}
