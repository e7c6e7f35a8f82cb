// The voxels round what the camera sees that were not seen before. A thread takes a texel of the g-buffer.
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
buffer Asked { uint data[]; } asked;  // By voxel, bits: it was seen, and all those round it.
writeonly buffer Found { uint data[]; } found;
buffer Count { uint value; } count;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uvec2 texels;
    int reach;  // Voxels along each axis.
} push;

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, push.texels))) return;
    const vec4 p = texelFetch(position, ivec2(texel), 0);
    if (p.w == 0.0) return;
    const ivec3 cell = voxelAt(push.grid, p.xyz);
    const uint own = voxelNumber(push.grid, cell);
    if (own != NO_VOXEL && (asked.data[own] & 2u) != 0u) return;
    for (int z = -push.reach; z <= push.reach; ++z)
        for (int y = -push.reach; y <= push.reach; ++y)
            for (int x = -push.reach; x <= push.reach; ++x) {
                const uint voxel = voxelNumber(push.grid, cell + ivec3(x, y, z));
                if (voxel == NO_VOXEL || (asked.data[voxel] & 1u) != 0u) continue;
                if ((atomicOr(asked.data[voxel], 1u) & 1u) == 0u) found.data[atomicAdd(count.value, 1u)] = voxel;
            }
    if (own != NO_VOXEL) atomicOr(asked.data[own], 2u);
}
