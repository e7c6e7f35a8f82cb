#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Adds the direct light that surfels reflect to what their rays bring, and sends a ray on from those where one goes on.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/surfels/surfel_types.h"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
layout(scalar) buffer Light { vec4 data[]; } light;
readonly buffer GoesOn { uint data[]; } goesOn;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint count;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    light.data[s.parent].rgb += s.reflectance * direct.data[i].rgb;

    Ray ray = Ray(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), -1.0);
    if (goesOn.data[i] != 0u) {
        ray.origin = s.position + s.normal * surfaceOffset(s.position);
        ray.direction = cosineDirection(sobol2(s.id, push.seed), s.normal);
        ray.tMax = 1.0e30;
    }
    rays.data[i] = ray;
}
