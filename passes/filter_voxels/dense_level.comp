#version 460
#extension GL_GOOGLE_include_directive : require
// One level of dense radiance voxels from the level below.
#include "shaders/compute/linear_index.glsl"
#include "shaders/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint level; } push;

void main() {
    const DenseLevel own = radianceVoxels.level[push.level], below = radianceVoxels.level[push.level - 1u];
    const uint i = linearIndex();
    const uvec3 size = own.resolution;
    if (i >= size.x * size.y * size.z) return;
    const ivec3 corner = 2 * ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    for (uint face = 0u; face < radianceVoxels.grid.directions; ++face) {
        vec4 child[8];
        for (uint cell = 0u; cell < 8u; ++cell) {
            const ivec3 voxel = corner + ivec3(cell & 1u, (cell >> 1) & 1u, cell >> 2);
            const bool inside = all(lessThan(voxel, ivec3(below.resolution)));
            child[cell] = inside ? radianceValue(radianceIndex(below, voxel), face) : vec4(0.0);
        }
        storeRadiance(own.first + i, face,
                      radianceVoxels.grid.directions == 6u ? combineFaces(child, face) : combineAll(child));
    }
}
