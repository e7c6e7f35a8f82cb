// Generates camera rays through low-discrepancy points of the image.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    vec3 origin;
    uint firstRay;
    vec3 forward;
    uint count;
    vec3 right;
    uint seed;
    vec3 up;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const vec2 p = 2.0 * sobol2(push.firstRay + i, push.seed) - 1.0;
    rays.data[i] = Ray(push.origin, 0.0, normalize(push.forward + p.x * push.right + p.y * push.up), 1.0e30);
}
