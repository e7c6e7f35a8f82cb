// Radiance voxels in a sparse octree (layout: svo): docs/svo.md.
#ifndef VOXRAY_RADIANCE_SVO_GLSL
#define VOXRAY_RADIANCE_SVO_GLSL

#include "shaders/octree/octree.glsl"
#include "passes/cones/radiance/radiance_texel.glsl"
#include "passes/cones/radiance/radiance_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer OctreeValues { uvec2 data[]; };
layout(scalar) readonly buffer RadianceVoxels {
    RadianceGrid grid;
    OctreeValues values;  // By direction, then by node: passes/cones/radiance/radiance_texel.glsl.
} radianceVoxels;

// Index of a node's value for a face (0 to 5 by direction, 0 where all share one).
uint octreeValueIndex(uint node, uint face) { return face * octree.shape.nodeCount + node; }

// Radiance times opacity, and opacity, of a node; 0 for NO_NODE.
vec4 radianceValue(uint node, uint face) {
    return unpackRadiance(radianceVoxels.values.data[octreeValueIndex(node, face)]);
}

#define NO_VALUE NO_NODE
#include "passes/cones/radiance/radiance_interpolation.glsl"

vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    vec3 fraction;
    const ivec3 corner = cornerVoxel(level, position, fraction);
    if (!inOctreeBorder(corner, level) || !inOctreeBorder(corner + 1, level)) return vec4(0.0);
    uint node[8];
    if (!octreeNodes(corner, level, node)) return vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant)
        if (octantWeight(octant, fraction) == 0.0) node[octant] = NO_NODE;

    return interpolateBlock(node, fraction, direction);
}

// The level of a uniform node where one replaces its descendants.
uint startLevel(vec3 position, float dither) {
    const RadianceGrid g = radianceVoxels.grid;
    const ivec3 voxel = ivec3(floor((position - g.origin) / g.voxelSize));
    uint level = inOctreeBorder(voxel, 0u) ? g.levels - 1u : 0u;
    for (; level > 0u; --level)
        if (isUniform(octreeWord(voxel >> level, level))) break;
    return level;
}

#endif
