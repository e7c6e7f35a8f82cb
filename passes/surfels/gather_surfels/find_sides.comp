// Finds which of each voxel's surfels are on which side of the voxel's axis, the normal of its first surfel.
#include "passes/surfels/gather_surfels/voxel_sides.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;
layout(scalar) readonly buffer LitRef { LitSurfels lit; };
layout(scalar) readonly buffer SidesRef { VoxelSides sides; };
layout(push_constant) uniform Push { uint voxels; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    const uvec2 range = surfelRanges.data[voxel];
    uint axis = 0u, positive = 0u;
    float largestSine = 0.0;
    for (uint i = range.x; i < min(range.y, range.x + 32u); ++i) {
        const vec3 n = unpackLit(lit.data[i]).normal;
        if (i == range.x) axis = packNormal(n);
        if (dot(n, unpackNormal(axis)) > 0.0) positive |= 1u << (i - range.x);
        largestSine = max(largestSine, length(cross(n, unpackNormal(axis))));
    }
    sides.data[voxel] = packSides(Sides(range.x, range.y, positive, packAxis(axis, largestSine)));
}
