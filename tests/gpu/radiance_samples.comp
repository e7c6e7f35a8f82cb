// Samples of radiance voxels, whatever their layout.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/sample_radiance.glsl"
layout(local_size_x = 64) in;

struct Query {
    vec3 position;
    float footprint;
    vec3 direction;
    float reserved;
};
layout(scalar) readonly buffer Queries { Query data[]; } queries;
layout(scalar) writeonly buffer Answers { vec4 data[]; } answers;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Query q = queries.data[i];
    answers.data[i] = sampleRadiance(q.position, q.footprint, q.direction);
}
