#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Samples radiance voxels at a list of places: what sampleRadiance() and emptyDistance() answer for each.
#include "shaders/linear_index.glsl"
#include "shaders/radiance_svo.glsl"
layout(local_size_x = 64) in;

struct Query {
    vec3 position;
    float footprint;
    vec3 direction;
    float reserved;
};
struct Answer {
    vec4 radiance;
    float empty;
};
layout(set = 0, binding = 0, scalar) readonly buffer Queries { Query data[]; } queries;
layout(set = 0, binding = 1, scalar) writeonly buffer Answers { Answer data[]; } answers;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Query q = queries.data[i];
    answers.data[i].radiance = sampleRadiance(q.position, q.footprint, q.direction);
    answers.data[i].empty = emptyDistance(q.position, q.footprint, q.direction);
}
