// Whether voxels hide pairs of points of surfaces from each other, and the part of the way in which they can.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 64) in;

struct Pair {
    vec3 a, normalA, b, normalB;
};
layout(scalar) readonly buffer Pairs { Pair data[]; } pairs;
struct Answer {
    uint isHidden;
    vec3 from, to;  // Both the first point, where nothing is traced.
};
layout(scalar) writeonly buffer Answers { Answer data[]; } answers;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Pair p = pairs.data[i];
    Answer answer = Answer(0u, p.a, p.a);
    if (segmentBetweenSurfaces(push.grid, p.a, p.normalA, p.b, p.normalB, answer.from, answer.to))
        answer.isHidden = uint(occluded(push.grid, answer.from, answer.to));
    else
        answer.to = answer.from = p.a;
    answers.data[i] = answer;
}
