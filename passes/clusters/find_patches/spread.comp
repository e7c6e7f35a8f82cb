// Each side takes the least label of its neighbours in its cluster, so that in the end those that hang together have one: that of their
// first. The order of threads has no part in that. A thread takes a side.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer FirstNeighbour { uint data[]; } firstNeighbour;
layout(scalar) readonly buffer NeighboursAt { LargeUints neighbours; };
readonly buffer OfVoxel { uint data[]; } ofVoxel;  // Clusters.
buffer Labels { uint data[]; } labels;
buffer Changed { uint count; } changed;
layout(push_constant) uniform Push { uint sideCount; } push;

void main() {
    const uint side = linearIndex();
    if (side >= push.sideCount) return;
    const uint cluster = ofVoxel.data[sides.data[side].voxel];
    uint label = labels.data[labels.data[side]];
    for (uint i = firstNeighbour.data[side]; i < firstNeighbour.data[side + 1u]; ++i) {
        const uint other = neighbours.data[i];
        if (other != NO_SIDE && ofVoxel.data[sides.data[other].voxel] == cluster) label = min(label, labels.data[other]);
    }
    if (label == labels.data[side]) return;
    labels.data[side] = label;
    atomicAdd(changed.count, 1u);
}
