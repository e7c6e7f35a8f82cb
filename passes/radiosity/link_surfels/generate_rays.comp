// Cosine-distributed rays from a batch of surfels.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/path_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint firstSurfel;
    uint rayCount;
    uint raysPerSurfel;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const Surfel s = surfels.data[push.firstSurfel + i / push.raysPerSurfel];
    // One Sobol sequence per surfel: its rays are well distributed over the hemisphere
    if (s.id == VOXRAY_NO_SURFEL) {
        rays.data[i] = kNoRay;
        return;
    }
    const vec3 direction = cosineDirection(sobol2(i % push.raysPerSurfel, hashCombine(push.seed, s.id)), s.normal);
    rays.data[i] = Ray(s.position, 0.0, direction, 1.0e30);
}
