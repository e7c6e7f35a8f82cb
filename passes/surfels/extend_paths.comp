// Moves the end of each path to the hit of its ray, on the side that the ray came from. Russian roulette by albedo ends paths early;
// survivors' reflectance and area make up for those. New ends are appended in any order; nothing that follows depends on it.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/path_ray.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Ends { Surfel data[]; } ends;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer NextEnds { Surfel data[]; } nextEnds;
layout(scalar) writeonly buffer NextRays { Ray data[]; } nextRays;
buffer NextCount { uint value; } nextCount;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    uint seed;
    uint geometric;  // 1: ends keep the geometric normal, for they are written to voxels.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Ray ray = rays.data[i];
    Surfel s;
    vec3 faceNormal;
    float offset;
    if (ray.tMax < ray.tMin || !surfelAtHit(hits.data[i], ray.origin, s, faceNormal, offset)) return;

    // Does the path survive?
    const Surfel from = ends.data[i];
    const vec3 albedo = s.reflectance;
    const float survive = max(albedo.r, max(albedo.g, albedo.b));
    if (sobol2(from.id, push.seed).x >= survive) return;
    s.reflectance = from.reflectance * albedo / survive;
    s.area = from.area / survive;

    // Its end, and its next ray.
    if (push.geometric != 0u) s.normal = faceNormal;
    s.voxel = voxelNumber(push.grid, voxelAt(push.grid, s.position));
    s.position += offset * faceNormal;
    s.id = from.id;
    s.parent = from.parent;
    const uint number = atomicAdd(nextCount.value, 1u);
    nextEnds.data[number] = s;
    nextRays.data[number] = pathRay(s, faceNormal, push.seed + 0x51u);
}
