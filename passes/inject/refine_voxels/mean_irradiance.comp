// Squared mean irradiance of all faces in each aligned block of BLOCK³ voxels of the coarsest level, whose light is in
// their children.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/refine_voxels/half_light.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Means { float data[]; } means;  // By block; the sum over colors, (W/m²)².
layout(push_constant, scalar) uniform Push {
    uvec3 blocks;
} push;

void main() {
    const uint block = linearIndex();
    if (block >= push.blocks.x * push.blocks.y * push.blocks.z) return;
    const ivec3 first = int(2 * BLOCK) * ivec3(block % push.blocks.x, block / push.blocks.x % push.blocks.y,
                                               block / (push.blocks.x * push.blocks.y));
    const VoxelGrid grid = voxelLevels.data[0].grid;
    vec3 flux = vec3(0.0);
    float total = 0.0;
    for (int i = 0; i < 8 * BLOCK * BLOCK * BLOCK; ++i) {
        const uint voxel =
            voxelNumber(grid, first + ivec3(i, i / (2 * BLOCK), i / (4 * BLOCK * BLOCK)) % (2 * BLOCK));
        if (voxel == NO_VOXEL) continue;
        for (uint face = 0u; face < 6u; ++face) {
            const HalfLight light = halfLight(6u * voxel + face, grid.voxelSize);
            flux += 0.5 * (light.a + light.b);
            total += light.area;
        }
    }
    const vec3 mean = total > 0.0 ? flux / total : vec3(0.0);
    means.data[block] = dot(mean, mean);
}
