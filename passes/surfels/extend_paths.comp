// Extends each path to the hit of its ray. Russian roulette by albedo ends paths early; survivors' throughput and area
// are divided by the probability to survive. New vertices are appended in any order, on which nothing depends.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/path_ray.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Vertices { Surfel data[]; } vertices;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer NextVertices { Surfel data[]; } nextVertices;
layout(scalar) writeonly buffer NextRays { Ray data[]; } nextRays;
buffer NextCount { uint value; } nextCount;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    uint seed;
    uint geometric;  // 1: vertices have the geometric normal, else the shading normal.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Ray ray = rays.data[i];
    Surfel s;
    vec3 faceNormal;
    float offset;
    if (ray.tMax < ray.tMin || !surfelAtHit(hits.data[i], ray.origin, s, faceNormal, offset)) return;

    // Russian roulette
    const Surfel previous = vertices.data[i];
    const vec3 albedo = s.reflectance;
    const float survival = survivalProbability(albedo);
    if (sobol2(previous.id, push.seed).x >= survival) return;
    s.reflectance = previous.reflectance * albedo / survival;
    s.area = previous.area / survival;

    // The new vertex and its ray
    if (push.geometric != 0u) s.normal = faceNormal;
    s.voxel = voxelNumber(push.grid, voxelAt(push.grid, s.position));
    s.position += offset * faceNormal;
    s.id = previous.id;
    s.parent = previous.parent;
    const uint next = atomicAdd(nextCount.value, 1u);
    nextVertices.data[next] = s;
    nextRays.data[next] = pathRay(s, faceNormal, push.seed + 0x51u);
}
