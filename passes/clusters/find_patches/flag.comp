// A bit for each side that leads a part: whose label is its own, in a cluster. A thread takes a word.
#include "passes/clusters/cluster_types.h"
#include "passes/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer OfVoxel { uint data[]; } ofVoxel;
readonly buffer Labels { uint data[]; } labels;
writeonly buffer Flags { uint words[]; } flags;
layout(push_constant) uniform Push { uint sideCount; } push;

void main() {
    const uint word = linearIndex();
    if (32u * word >= push.sideCount) return;
    uint bits = 0u;
    for (uint i = 0u; i < 32u && 32u * word + i < push.sideCount; ++i) {
        const uint side = 32u * word + i;
        if (labels.data[side] == side && ofVoxel.data[sides.data[side].voxel] != NO_CLUSTER) bits |= 1u << i;
    }
    flags.words[word] = bits;
}
