// One level of radiance voxels in full grids from the level below.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint level; } push;

void main() {
    const RadianceGrid g = radianceVoxels.grid;
    const RADIANCE_LEVEL own = radianceLevel(push.level), below = radianceLevel(push.level - 1u);
    const uint i = linearIndex();
    const uvec3 size = levelResolution(g, push.level), sizeBelow = levelResolution(g, push.level - 1u);
    if (i >= size.x * size.y * size.z) return;
    const ivec3 at = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    for (uint face = 0u; face < g.directions; ++face) {
        vec4 child[8];
        for (uint cell = 0u; cell < 8u; ++cell) {
            const ivec3 voxel = 2 * at + ivec3(cell & 1u, (cell >> 1) & 1u, cell >> 2);
            const bool inside = all(lessThan(voxel, ivec3(sizeBelow)));
            child[cell] = inside ? radianceValue(radianceIndex(below, voxel), face) : vec4(0.0);
        }
        storeRadiance(radianceIndex(own, at), face, g.directions == 6u ? combineFaces(child, face) : combineAll(child));
    }
}
