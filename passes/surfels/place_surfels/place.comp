// Two surfels at each point, one on either side of the surface, and the rays that test whether they are occluded. Rays
// of invalid surfels are inactive.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/occlusion_ray.glsl"
#include "passes/surfels/surfel_points.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Candidates { Surfel data[]; } candidates;
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
    const vec3 albedo = clamp(diffuseAlbedo(m, p, 0.0), 0.0, 1.0);
    for (uint side = 0u; side < 2u; ++side) {
        Surfel s;
        s.normal = surfelNormal(p, side);
        s.position = surfelPosition(p, s.normal);
        s.voxel = voxel;
        s.id = 2u * (push.firstPoint + i) + side;
        s.reflectance = albedo;
        s.parent = 0u;
        s.area = 1.0;
        candidates.data[2u * i + side] = s;
        const bool isValid = voxel != NO_VOXEL && !isCut && dot(s.normal, s.normal) > 0.0;
        rays.data[2u * i + side] = isValid ? occlusionRay(s.position, s.normal, push.grid.voxelSize) : kNoRay;
    }
}
