// A cosine-distributed ray from each surfel, as long as the bound, unless Russian roulette ends the path.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/octahedral.glsl"
#include "passes/surfels/path_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
readonly buffer FaceNormals { uint data[]; } faceNormals;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    uint count;
    uint seed;
    float radius;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    Ray ray = kNoRay;
    if (sobol2(s.id, hashCombine(push.seed, 1u)).x < survivalProbability(s.reflectance))
        ray = pathRay(s, fromOctahedral(faceNormals.data[i]), push.seed);
    ray.tMax = min(ray.tMax, push.radius);
    rays.data[i] = ray;
}
