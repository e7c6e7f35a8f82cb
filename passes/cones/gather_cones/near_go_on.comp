// The ends of rays that went on from near hits, and what cones find beyond.
#include "passes/cones/gather_cones/near_end.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer From { Surfel data[]; } from;       // That the rays started from.
layout(scalar) readonly buffer WentOn { uvec2 data[]; } wentOn;  // The same surfels' geometric normals.
layout(push_constant, scalar) uniform Push {
    uint rayCount;
    float range;  // m; 0 where rays must end.
    float width;  // Of the cones, at unit distance.
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const Surfel s = from.data[i];
    endRay(i, s.parent, fromOctahedral(wentOn.data[i].y), s.reflectance, push.width, push.range, s.id, sobol2(s.id, push.seed));
}
