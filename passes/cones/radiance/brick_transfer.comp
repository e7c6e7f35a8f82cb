// Makes the values equal that two bricks share across an axis (Arnebäck 2017, section 3.2.3, figure 27). The first pass
// writes their mean (leaves) or sum (partial sums of the filter) to the neighbor up the axis, the second copies it back
// to the one down the axis.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uint axis;
    float weight;  // Of the sum of both.
    uint isBack;
} push;

void main() {
    if (linearIndex() >= nodesOf(push.nodes)) return;
    const uint node = levelNode(push.nodes, linearIndex()), brick = radianceVoxels.nodes.data[node].brick;
    const uint neighbor = radianceVoxels.nodes.data[node].neighbor[push.axis + 3u * push.isBack];
    if (brick == NO_BRICK || neighbor == NO_NEIGHBOR) return;
    const uint neighborBrick = radianceVoxels.nodes.data[neighbor].brick;
    if (neighborBrick == NO_BRICK) return;
    for (int i = 0; i < 9; ++i) {
        ivec3 texel, neighborTexel;
        texel[(push.axis + 1u) % 3u] = neighborTexel[(push.axis + 1u) % 3u] = i % 3;
        texel[(push.axis + 2u) % 3u] = neighborTexel[(push.axis + 2u) % 3u] = i / 3;
        texel[push.axis] = push.isBack == 1u ? 0 : 2;
        neighborTexel[push.axis] = 2 - texel[push.axis];
        const vec4 value = brickValue(brick, texel);
        storeBrickValue(neighborBrick, neighborTexel,
                        push.isBack == 1u ? value : push.weight * (value + brickValue(neighborBrick, neighborTexel)));
    }
}
