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
    const RADIANCE_INDEX index = radianceIndex(push.level, voxel);
    const uint surfaceVoxel = voxelNumber(push.grid, voxel);
    for (uint face = 0u; face < radianceVoxels.grid.directions; ++face)
        storeRadiance(index, face, voxelRadiance(push.grid, surfaceVoxel, face, 0.0));
}
