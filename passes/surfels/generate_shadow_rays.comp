// One shadow ray from each surfel towards a source of light, with the irradiance that arrives if nothing is in the way.
#include "shaders/lights/lights.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Carried { vec4 data[]; } carried;
layout(push_constant, scalar) uniform Push {
    uint count;
    uint kind;
    uint light;
    uint samples;
    uint emitterCount;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    const LightSample l = sampleSource(push.kind, push.light, push.samples, push.emitterCount, s.position, s.normal, s.id, push.seed);
    const vec3 irradiance = l.irradiance * max(dot(s.normal, l.direction), 0.0);
    Ray ray;
    ray.origin = s.position;
    ray.direction = l.direction;
    ray.tMin = 0.0;
    ray.tMax = any(greaterThan(irradiance, vec3(0.0))) ? l.reach : -1.0;
    rays.data[i] = ray;
    carried.data[i] = vec4(irradiance, 0.0);
}
