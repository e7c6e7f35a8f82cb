// Fills a box of a clipmap level's voxels from the surface voxels of the level.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
#include "passes/cones/radiance/surface_radiance.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    ivec3 boxFirst;
    uvec3 boxSize;
    uint level;
} push;

void main() {
    const uint i = linearIndex();
    const uvec3 size = push.boxSize;
    if (i >= size.x * size.y * size.z) return;
    const ivec3 voxel = push.boxFirst + ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    const CLIPMAP_SLOT slot = clipmapSlot(push.level, voxel);
    const uint surfaceVoxel = voxelNumber(push.grid, voxel);
    const uint directions = radianceVoxels.grid.directions;
    for (uint face = 0u; face < directions; ++face) {
        vec4 value = vec4(0.0);
        if (surfaceVoxel != NO_VOXEL)
            value = directions == 6u ? faceRadiance(push.grid, surfaceVoxel, face, 0.0)
                                     : meanRadiance(push.grid, surfaceVoxel, 0.0);
        storeRadiance(slot, face, value);
    }
}
