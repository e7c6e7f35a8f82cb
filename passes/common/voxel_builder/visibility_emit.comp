// Two rays to each probe point that lies in one of the voxels, one to each of its sides, from a voxel's length away.
#include "passes/common/voxel_builder/visibility_point.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer Points { uvec2 data[]; } points;  // Triangle, and number of the point on it.
layout(scalar) writeonly buffer KeptPoints { ProbePoint data[]; } keptPoints;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
buffer Kept { uint count; } kept;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uvec2 point = points.data[i];
    const SurfacePoint s = surfacePoint(point.x, trianglePoint(sobol2(point.y, hashCombine(push.seed, point.x))));
    if (s.geometricNormal == vec3(0.0) || alphaCut(sceneMaterials.data[s.material], s)) return;
    if (!isOccupied(push.grid, voxelAt(push.grid, s.position))) return;

    const uint at = atomicAdd(kept.count, 1u);
    keptPoints.data[at] = ProbePoint(s.position, point.x);
    for (uint side = 0u; side < 2u; ++side) {
        const vec3 normal = side == 0u ? s.geometricNormal : -s.geometricNormal;
        Ray ray;
        ray.origin = s.position + normal * push.grid.voxelSize;
        ray.direction = -normal;
        ray.tMin = 0.0;
        ray.tMax = push.grid.voxelSize + s.offset;
        rays.data[2u * at + side] = ray;
    }
}
