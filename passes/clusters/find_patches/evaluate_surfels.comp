// Evaluates the surfels of a batch of points. Of those that do not exist, `voxel` is NO_VOXEL.
#include "passes/surfels/surfel_points.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SidesRef { LargeUints sides; };
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint firstPoint;
    uint points;
    uint pointSeed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.points) return;
    const uint pointNumber = push.firstPoint + i;
    const SurfacePoint p = surfacePointOf(pointNumber, push.pointSeed);
    const uint voxel = voxelNumber(push.grid, voxelAt(push.grid, p.position));
    const vec3 albedo = clamp(diffuseAlbedo(sceneMaterials.data[p.material], p, 0.0), 0.0, 1.0);
    for (uint side = 0u; side < 2u; ++side) {
        const uint id = 2u * pointNumber + side;
        const uint kind = sideOf(sides.data[id / SURFELS_PER_WORD], id);
        const vec3 normal = surfelNormal(p, side);
        surfels.data[2u * i + side] = Surfel(surfelPosition(p, normal), kind == SURFEL_NONE ? NO_VOXEL : voxel, normal,
                                             id, albedo, 0u, kind == SURFEL_OPEN ? 1.0 : 0.0);
    }
}
