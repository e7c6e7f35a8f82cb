// A clipmap level that is held whole from the level below, which is too. A thread takes a voxel.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint level; } push;

void main() {
    const ClipmapWindow own = radianceVoxels.window[push.level], below = radianceVoxels.window[push.level - 1u];
    const uint i = linearIndex();
    const uvec3 size = own.size;
    if (i >= size.x * size.y * size.z) return;
    const ivec3 voxel = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    for (uint face = 0u; face < radianceVoxels.grid.directions; ++face) {
        vec4 child[8];
        for (uint cell = 0u; cell < 8u; ++cell) {
            const ivec3 at = blockVoxel(2 * voxel, cell);
            child[cell] = inWindow(below, at) ? radianceValue(clipmapSlot(push.level - 1u, at), face) : vec4(0.0);
        }
        storeRadiance(clipmapSlot(push.level, voxel), face,
                      radianceVoxels.grid.directions == 6u ? combineFaces(child, face) : combineAll(child));
    }
}
