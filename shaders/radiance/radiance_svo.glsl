// Radiance voxels in a sparse octree (layout: svo): docs/svo.md.
#ifndef VOXRAY_RADIANCE_SVO_GLSL
#define VOXRAY_RADIANCE_SVO_GLSL

#include "shaders/octree/octree.glsl"
#define NO_PLACE NO_NODE
#include "shaders/radiance/radiance_interpolation.glsl"

vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    vec3 at;
    const ivec3 corner = cornerVoxel(level, position, at);
    if (!inOctreeBorder(corner, level) || !inOctreeBorder(corner + 1, level)) return vec4(0.0);
    uint node[8];
    if (!octreeNodes(corner, level, node)) return vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant)
        if (octantWeight(octant, at) == 0.0) node[octant] = NO_NODE;

    return interpolateBlock(node, at, direction);
}

// The largest cube that holds none of the voxels that a sample here reads, on either of its two levels: those of the coarser
// level enclose the others.
float emptyDistance(vec3 position, float footprint, vec3 direction) {
    const RadianceGrid g = radianceVoxels.grid;
    const uint coarser = min(uint(max(ceil(log2(footprint / g.voxelSize)), 0.0)), g.levels - 1u);
    vec3 at;
    const ivec3 corner = cornerVoxel(coarser, position, at);
    if (!inOctreeBorder(corner, coarser) || !inOctreeBorder(corner + 1, coarser)) return 0.0;
    uint emptyLevel = 0u;
    for (uint level = max(coarser, 1u); level <= g.levels; ++level) {
        const ivec3 cube = corner >> (level - coarser);
        if (cube != (corner + 1) >> (level - coarser)) continue;
        if (octreeWord(cube, level) != 0u) break;
        emptyLevel = level;
    }
    if (emptyLevel == 0u) return 0.0;

    // The position may move until a voxel that it reads leaves the cube: to half a voxel before the cube's faces.
    const uint up = emptyLevel - coarser;
    const float side = g.voxelSize * float(1u << coarser);
    const vec3 low = g.origin + side * (vec3((corner >> up) << up) + 0.5);
    const vec3 high = g.origin + side * (vec3(((corner >> up) + 1) << up) - 0.5);
    float reach = 1.0e30;
    for (uint axis = 0u; axis < 3u; ++axis)
        if (direction[axis] != 0.0)
            reach = min(reach, ((direction[axis] > 0.0 ? high[axis] : low[axis]) - position[axis]) / direction[axis]);
    return max(reach, 0.0);
}

// That of a uniform node where one stands for all.
uint startLevel(vec3 position, float dither) {
    const RadianceGrid g = radianceVoxels.grid;
    const ivec3 voxel = ivec3(floor((position - g.origin) / g.voxelSize));
    uint level = inOctreeBorder(voxel, 0u) ? g.levels - 1u : 0u;
    for (; level > 0u; --level)
        if (isUniform(octreeWord(voxel >> level, level))) break;
    return level;
}

#endif
