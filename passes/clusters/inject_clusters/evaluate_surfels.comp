// Evaluates a range of surfels, to be lit: position, normal and id.
#include "passes/surfels/surfel_points.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SurfelIdsRef { LargeUints surfelIds; };
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
layout(push_constant) uniform Push {
    uint first;
    uint count;
    uint pointSeed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint id = surfelIds.data[push.first + i];
    const SurfelGeometry s = surfelGeometry(id, push.pointSeed);
    surfels.data[i].position = s.position;
    surfels.data[i].normal = s.normal;
    surfels.data[i].id = id;
}
