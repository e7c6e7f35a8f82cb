#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Whether voxels hide pairs of points of surfaces from each other.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 64) in;

struct Pair {
    vec3 a, normalA, b, normalB;
};
layout(scalar) readonly buffer Pairs { Pair data[]; } pairs;
writeonly buffer Answers { uint data[]; } answers;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Pair p = pairs.data[i];
    answers.data[i] = uint(occludedBetweenSurfaces(push.grid, p.a, p.normalA, p.b, p.normalB));
}
