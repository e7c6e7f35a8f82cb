// Shades the hits of continuation rays.
#include "passes/final_gather/stored_light/shade_hit.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Origins { Surfel data[]; } origins;  // Surfels that the rays start from.
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(push_constant, scalar) uniform Push {
    uint rays_;
    float nearField;  // Cells; 0: paths end at these hits.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rays_ || rays.data[i].tMax < 0.0) return;
    const Surfel s = origins.data[i];
    atomicAdd(counts.traced, 1u);
    vec3 throughput = s.reflectance / max(survivalProbability(s.reflectance), 1e-6);  // Of Russian roulette.
    if (s.voxel == VOXRAY_MIRROR_VERTEX) {
        throughput = s.reflectance;
        light.data[s.parent].rgb += PI * throughput * emittedTowardsMirror(hits.data[i], rays.data[i]);
    }
    if (hits.data[i].triangle == NO_HIT) return;
    shadeHit(s.parent, hits.data[i], rays.data[i].origin, throughput, s.id, push.nearField);
}
