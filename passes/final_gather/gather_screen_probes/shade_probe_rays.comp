// Shades the hit of each probe ray with stored light: radiance times pi. Rays that miss get none, as the environment is
// direct light.
#include "passes/final_gather/stored_light/shade_hit.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(push_constant, scalar) uniform Push {
    uint firstRay;
    uint rayCount;
    float nearField;  // Cells.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    light.data[i] = vec4(0.0);
    if (hits.data[i].triangle != NO_HIT)
        shadeHit(i, hits.data[i], rays.data[i].origin, vec3(1.0), push.firstRay + i, push.nearField);
}
