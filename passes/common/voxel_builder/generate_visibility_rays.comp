// Generates two rays to each probe point in an occupied voxel, one to each side of the surface, from a voxel's width
// away. Other points are dropped.
#include "passes/common/voxel_builder/probe_point.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer Candidates { uvec2 data[]; } candidates;  // Triangle, and index of the point on it.
layout(scalar) writeonly buffer ProbePoints { ProbePoint data[]; } probePoints;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
buffer PointCount { uint value; } pointCount;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    uint seed;
} push;

// Seed of a triangle's points, from where it is and not from its number: coincident copies of a triangle have the same
// points, of whose rays each hits one copy. Points of their own would count both copies in some places and none in others.
// In parts of a voxel, so that a scene has the same points at any scale.
uint pointSeed(uint triangle) {
    const vec3 center = surfacePoint(triangle, vec2(1.0 / 3.0)).position;
    const uvec3 place = uvec3(ivec3(round(256.0 / push.grid.voxelSize * center)));
    return hashCombine(hashCombine(hashCombine(push.seed, place.x), place.y), place.z);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uvec2 candidate = candidates.data[i];
    const vec2 u = sobol2(candidate.y, pointSeed(candidate.x));
    const SurfacePoint s = surfacePoint(candidate.x, trianglePoint(u));
    if (s.geometricNormal == vec3(0.0) || alphaCut(sceneMaterials.data[s.material], s)) return;
    if (!isOccupied(push.grid, voxelAt(push.grid, s.position))) return;

    const uint point = atomicAdd(pointCount.value, 1u);
    probePoints.data[point] = ProbePoint(s.position, candidate.x);
    for (uint side = 0u; side < 2u; ++side) {
        const vec3 normal = side == 0u ? s.geometricNormal : -s.geometricNormal;
        rays.data[2u * point + side] =
            Ray(s.position + normal * push.grid.voxelSize, 0.0, -normal, push.grid.voxelSize + s.offset);
    }
}
