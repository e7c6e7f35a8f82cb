// Fragment callback: adds the angles between a fragment's normal and the axes to its voxel's sums (Cosin and Patow
// 2022, figure 7). A fragment is the part of a triangle in a voxel. Integer sums do not depend on the order.
#include "passes/clusters/cluster_voxels/fragment_angle_sums.glsl"
#include "passes/common/triangle_voxelizer/exact.glsl"
#include "shaders/voxels/voxels.glsl"

void processFragment(TriangleFragment f) {
    const uint voxel = voxelNumber(voxelizer.grid, f.voxel);
    if (voxel == NO_VOXEL) return;
    ClippedFragment c;
    // A triangle that only touches the voxel has no fragment in it, but rounding may result in a small area
    if (!clipFragment(f, c) || c.area < kMargin) return;
    const vec3 angles = acos(clamp(surfacePoint(f.triangle, c.center).normal, -1.0, 1.0));
    const uvec3 units = uvec3(round(angles * voxelizer.fixedPointScale));
    for (uint k = 0u; k < 3u; ++k) atomicAdd(fragmentAngleSums.data[ANGLE_SUMS * voxel + k], units[k]);
    atomicAdd(fragmentAngleSums.data[ANGLE_SUMS * voxel + 3u], 1u);
}
