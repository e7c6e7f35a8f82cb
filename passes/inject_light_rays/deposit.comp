#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
// Leaves what each ray carries in the voxel that it hit, then turns it into its next bounce.
#include "shaders/linear_index.glsl"
#include "shaders/sampling.glsl"
#include "shaders/scene.glsl"
#include "shaders/shared/ray_types.h"
#include "shaders/voxels.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 16, scalar) buffer Rays { Ray data[]; } rays;
layout(set = 0, binding = 17, scalar) buffer Carried { vec4 data[]; } carried;
layout(set = 0, binding = 18, scalar) readonly buffer Hits { Hit data[]; } hits;
layout(set = 0, binding = 19, scalar) buffer Sums { uint64_t data[]; } sums;
layout(set = 0, binding = 20) readonly buffer Hidden { uint data[]; } hidden;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstRay;
    uint batchRays;
    uint seed;
    uint bounce;
    uint lastBounce;
    float unitsPerWatt;
} push;

// The voxel of a hit. Where voxelization left it empty (three_axis: the surface fell between its samples), the nearest of the
// voxels around it takes the light, so that none is lost where there is a voxel next door.
uint receivingVoxel(vec3 position) {
    const ivec3 cell = voxelAt(push.grid, position);
    const uint own = voxelNumber(push.grid, cell);
    if (own != NO_VOXEL) return own;
    const vec3 inGrid = (position - push.grid.origin) / push.grid.voxelSize;
    uint nearest = NO_VOXEL;
    float best = 1.0e30;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const ivec3 neighbour = cell + ivec3(x, y, z);
                const vec3 away = vec3(neighbour) + 0.5 - inGrid;
                if (dot(away, away) >= best) continue;
                const uint voxel = voxelNumber(push.grid, neighbour);
                if (voxel == NO_VOXEL) continue;
                nearest = voxel;
                best = dot(away, away);
            }
    return nearest;
}

void deposit(uint voxel, vec3 watts, vec3 normal) {
    // A surface's flux goes to the three directions it faces, by the squares of its normal's components.
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float share = normal[axis] * normal[axis] * push.unitsPerWatt;
        const uint face = 2u * axis + (normal[axis] < 0.0 ? 1u : 0u);
        for (uint c = 0u; c < 3u; ++c) {
            const uint64_t units = uint64_t(watts[c] * share);
            if (units != 0ul) atomicAdd(sums.data[(voxel * 6u + face) * 3u + c], units);
        }
    }
}

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    Ray ray = rays.data[i];
    if (ray.tMax < ray.tMin) return;
    const Hit hit = hits.data[i];
    rays.data[i].tMax = -1.0;
    if (hit.triangle == NO_HIT) return;

    // Deposit on the side that the ray came from, if open space lies before it, as voxelization counts its area.
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return;
    const vec3 normal = dot(s.geometricNormal, ray.direction) <= 0.0 ? s.geometricNormal : -s.geometricNormal;
    const vec3 watts = carried.data[i].rgb;
    if (hidden.data[i] == 0u) {
        const uint voxel = receivingVoxel(s.position);
        if (voxel != NO_VOXEL) deposit(voxel, watts, normal);
    }
    if (push.bounce == push.lastBounce) return;

    // Russian roulette by albedo keeps the power of surviving rays level; then a cosine-distributed bounce.
    const GpuMaterial m = sceneMaterials.data[s.material];
    const vec3 albedo = clamp(diffuseAlbedo(m, s, 0.0), 0.0, 1.0);
    const float survive = max(albedo.r, max(albedo.g, albedo.b));
    const uint index = push.firstRay + i;
    const uint seed = hashCombine(push.seed, 16u + 2u * push.bounce);
    if (sobol2(index, hashCombine(seed, 1u)).x >= survive) return;
    vec3 bounceNormal = shadingNormal(m, s, 0.0);
    if (dot(bounceNormal, normal) < 0.0) bounceNormal = -bounceNormal;
    const vec3 direction = cosineDirection(sobol2(index, seed), bounceNormal);
    if (dot(direction, normal) <= 0.0) return;
    carried.data[i] = vec4(watts * albedo / survive, 0.0);
    ray.origin = s.position + normal * surfaceOffset(s.position);
    ray.direction = direction;
    ray.tMin = 0.0;
    ray.tMax = 1.0e30;
    rays.data[i] = ray;
}
