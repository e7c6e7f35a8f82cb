// Values that two bricks share across an axis made equal (Arnebäck 2017, section 3.2.3, figure 27). A thread takes a node of the level:
// in the first pass it writes the mean (of leaves) or the sum (of partial results of the filter) to its neighbour up the axis, in
// the second back to its neighbour down the axis.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uint axis;
    float part;  // Of the sum of both.
    uint isBack;
} push;

void main() {
    if (linearIndex() >= nodesOf(push.nodes)) return;
    const uint node = levelNode(push.nodes, linearIndex()), brick = radianceVoxels.nodes.data[node].brick;
    const uint neighbor = radianceVoxels.nodes.data[node].neighbor[push.axis + 3u * push.isBack];
    if (brick == NO_BRICK || neighbor == NO_NEIGHBOR) return;
    const uint other = radianceVoxels.nodes.data[neighbor].brick;
    if (other == NO_BRICK) return;
    for (int i = 0; i < 9; ++i) {
        ivec3 own, theirs;
        own[(push.axis + 1u) % 3u] = theirs[(push.axis + 1u) % 3u] = i % 3;
        own[(push.axis + 2u) % 3u] = theirs[(push.axis + 2u) % 3u] = i / 3;
        own[push.axis] = push.isBack == 1u ? 0 : 2;
        theirs[push.axis] = 2 - own[push.axis];
        const vec4 value = brickValue(brick, own);
        storeBrickValue(other, theirs,
                        push.isBack == 1u ? value : push.part * (value + brickValue(other, theirs)));
    }
}
