// Filters a level of radiance voxels from the next finer one. Both are full grids, or windows that are.
#include "passes/cones/radiance/radiance_voxels.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint level; } push;

void main() {
    const RadianceGrid g = radianceVoxels.grid;
    const RADIANCE_LEVEL level = radianceLevel(push.level), finer = radianceLevel(push.level - 1u);
    const uint i = linearIndex();
    const uvec3 size = levelResolution(g, push.level), finerSize = levelResolution(g, push.level - 1u);
    if (i >= size.x * size.y * size.z) return;
    const ivec3 voxel = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    for (uint face = 0u; face < g.directions; ++face) {
        vec4 values[8];
        for (uint octant = 0u; octant < 8u; ++octant) {
            const ivec3 child = blockVoxel(2 * voxel, octant);
            const bool inside = all(lessThan(child, ivec3(finerSize)));
            values[octant] = inside ? radianceValue(radianceIndex(finer, child), face) : vec4(0.0);
        }
        storeRadiance(radianceIndex(level, voxel), face,
                      g.directions == 6u ? combineFaces(values, face) : combineAll(values));
    }
}
