// Filters a clipmap level that is held whole from the level below, which is held whole, too.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint level; } push;

void main() {
    const ClipmapWindow window = radianceVoxels.window[push.level], finer = radianceVoxels.window[push.level - 1u];
    const uint i = linearIndex();
    const uvec3 size = window.size;
    if (i >= size.x * size.y * size.z) return;
    const ivec3 voxel = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    for (uint face = 0u; face < radianceVoxels.grid.directions; ++face) {
        vec4 values[8];
        for (uint octant = 0u; octant < 8u; ++octant) {
            const ivec3 child = blockVoxel(2 * voxel, octant);
            values[octant] = inWindow(finer, child) ? radianceValue(clipmapSlot(push.level - 1u, child), face) : vec4(0.0);
        }
        storeRadiance(clipmapSlot(push.level, voxel), face,
                      radianceVoxels.grid.directions == 6u ? combineFaces(values, face) : combineAll(values));
    }
}
