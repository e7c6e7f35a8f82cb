// A box of a clipmap level's window, and the region of voxels that is rasterized: those of the window that are in the
// level's grid.
#ifndef VOXRAY_REGION_BOX_GLSL
#define VOXRAY_REGION_BOX_GLSL

#include "shaders/compute/linear_index.glsl"

layout(push_constant, scalar) uniform Push {
    ivec3 first;  // Of the region.
    uvec3 end;
    ivec3 boxFirst;
    uvec3 boxSize;
    uint level;
    uint firstVoxel;  // Of the level, among the voxels that are rasterized at once.
} push;

// The voxel of this invocation; false beyond the box.
bool voxelOfBox(out ivec3 voxel) {
    const uint i = linearIndex();
    const uvec3 size = push.boxSize;
    voxel = push.boxFirst + ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    return i < size.x * size.y * size.z;
}

bool isInRegion(ivec3 voxel) {
    return all(greaterThanEqual(voxel, push.first)) && all(lessThan(voxel, ivec3(push.end)));
}

#endif
