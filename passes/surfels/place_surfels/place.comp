// Rays that test whether the two surfels at each point, one on either side of the surface, are occluded. Rays of invalid
// surfels are inactive. SURFELS: stores the surfels, too.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/occlusion_ray.glsl"
#include "passes/surfels/surfel_points.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
#ifdef SURFELS
layout(scalar) writeonly buffer Candidates { Surfel data[]; } candidates;
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstPoint;
    uint points;
    uint pointSeed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.points) return;
    const SurfacePoint p = surfacePointOf(push.firstPoint + i, push.pointSeed);
    const uint voxel = voxelNumber(push.grid, voxelAt(push.grid, p.position));
    const GpuMaterial m = sceneMaterials.data[p.material];
    const bool isCut = alphaCut(m, p);
#ifdef SURFELS
    const vec3 albedo = clamp(diffuseAlbedo(m, p, 0.0), 0.0, 1.0);
#endif
    for (uint side = 0u; side < 2u; ++side) {
        const vec3 normal = surfelNormal(p, side), position = surfelPosition(p, normal);
#ifdef SURFELS
        candidates.data[2u * i + side] =
            Surfel(position, voxel, normal, 2u * (push.firstPoint + i) + side, albedo, 0u, 1.0);
#endif
        const bool isValid = voxel != NO_VOXEL && !isCut && dot(normal, normal) > 0.0;
        rays.data[2u * i + side] = isValid ? occlusionRay(position, normal, push.grid.voxelSize) : kNoRay;
    }
}
