// Adds the direct light that the surfel at each hit reflects to its gather ray, and generates the next ray of its path.
// A mirror's vertex reflects no light of shadow rays. With ROULETTE survivalProbability() of their reflectance decides
// which other paths continue; who reads the rays divides by it.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/octahedral.glsl"
#include "passes/surfels/path_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;  // W/m²
layout(scalar) buffer Light { vec4 data[]; } light;             // Of gather rays.
// By surfel: whether its path continues; geometric normal.
layout(scalar) readonly buffer Continuations { uvec2 data[]; } continuations;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint count;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    if (s.voxel == VOXRAY_MIRROR_VERTEX) {
        rays.data[i] = Ray(s.position, 0.0, s.normal, 1.0e30);
        return;
    }
    light.data[s.parent].rgb += s.reflectance * direct.data[i].rgb;

    const uvec2 continuation = continuations.data[i];
    bool isContinued = continuation.x != 0u;
#ifdef ROULETTE
    isContinued = isContinued && sobol2(s.id, hashCombine(push.seed, 1u)).x < survivalProbability(s.reflectance);
#endif
    rays.data[i] = isContinued ? pathRay(s, fromOctahedral(continuation.y), push.seed) : kNoRay;
}
