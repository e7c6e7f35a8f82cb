#version 460
#extension GL_GOOGLE_include_directive : require
// One level of radiance voxels in full grids from the level below.
#include "shaders/compute/linear_index.glsl"
#include "shaders/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint level; } push;

void main() {
    const RadianceGrid g = radianceVoxels.grid;
    const uint i = linearIndex();
    const uvec3 size = levelResolution(g, push.level), sizeBelow = levelResolution(g, push.level - 1u);
    if (i >= size.x * size.y * size.z) return;
    const ivec3 own = ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    const RADIANCE_PLACE place = radiancePlace(push.level, own);
    RADIANCE_PLACE below[8];
    bool inside[8];
    for (uint cell = 0u; cell < 8u; ++cell) {
        const ivec3 voxel = 2 * own + ivec3(cell & 1u, (cell >> 1) & 1u, cell >> 2);
        inside[cell] = all(lessThan(voxel, ivec3(sizeBelow)));
        below[cell] = radiancePlace(push.level - 1u, voxel);
    }
    for (uint face = 0u; face < g.directions; ++face) {
        vec4 child[8];
        for (uint cell = 0u; cell < 8u; ++cell)
            child[cell] = inside[cell] ? radianceValue(below[cell], face) : vec4(0.0);
        storeRadiance(place, face, g.directions == 6u ? combineFaces(child, face) : combineAll(child));
    }
}
