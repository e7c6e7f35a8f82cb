// Marks the voxels around each texel of the G-buffer as requested, and lists those that were not requested before.
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

#define REQUESTED 1u
#define NEIGHBORHOOD_REQUESTED 2u

uniform sampler2D position;
buffer RequestedVoxels { uint data[]; } requestedVoxels;  // Per voxel: the bits above.
writeonly buffer NewVoxels { uint data[]; } newVoxels;
buffer Count { uint value; } count;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uvec2 texels;
    int reach;  // Distance of requested voxels along each axis, voxels.
} push;

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, push.texels))) return;
    const vec4 p = texelFetch(position, ivec2(texel), 0);
    if (p.w == 0.0) return;
    const ivec3 center = voxelAt(push.grid, p.xyz);
    const uint centerVoxel = voxelNumber(push.grid, center);
    if (centerVoxel != NO_VOXEL && (requestedVoxels.data[centerVoxel] & NEIGHBORHOOD_REQUESTED) != 0u) return;
    for (int z = -push.reach; z <= push.reach; ++z)
        for (int y = -push.reach; y <= push.reach; ++y)
            for (int x = -push.reach; x <= push.reach; ++x) {
                const uint voxel = voxelNumber(push.grid, center + ivec3(x, y, z));
                if (voxel == NO_VOXEL || (requestedVoxels.data[voxel] & REQUESTED) != 0u) continue;
                if ((atomicOr(requestedVoxels.data[voxel], REQUESTED) & REQUESTED) == 0u)
                    newVoxels.data[atomicAdd(count.value, 1u)] = voxel;
            }
    if (centerVoxel != NO_VOXEL) atomicOr(requestedVoxels.data[centerVoxel], NEIGHBORHOOD_REQUESTED);
}
