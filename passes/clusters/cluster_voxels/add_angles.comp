// A walk's visitor: adds the angles between a fragment's normal and the axes to its voxel's sums (Cosin and Patow 2022, figure 7). A
// fragment is the part of a triangle in a voxel. In whole numbers: the same in any order.
#include "passes/clusters/cluster_voxels/fragment_angles.glsl"
#include "passes/common/triangle_walk/exact.glsl"
#include "shaders/voxels/voxels.glsl"

void visitFragment(TriangleFragment f) {
    const uint voxel = voxelNumber(walk.grid, f.voxel);
    if (voxel == NO_VOXEL) return;
    ClippedFragment c;
    // What only touches the voxel is no fragment: areas are good to the digits of grid coordinates
    if (!clipFragment(f, c) || c.area < kMargin) return;
    const vec3 angles = acos(clamp(surfacePoint(f.triangle, c.center).normal, -1.0, 1.0));
    const uvec3 units = uvec3(round(angles * walk.visitorScale));
    for (uint k = 0u; k < 3u; ++k) atomicAdd(fragmentAngles.data[ANGLE_SUMS * voxel + k], units[k]);
    atomicAdd(fragmentAngles.data[ANGLE_SUMS * voxel + 3u], 1u);
}
