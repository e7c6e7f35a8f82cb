// Radiance voxels in an octree of bricks as published in Arnebäck 2017, chapter 3 (layout: svo_bricks): docs/svo.md.
#ifndef VOXRAY_RADIANCE_SVO_BRICKS_GLSL
#define VOXRAY_RADIANCE_SVO_BRICKS_GLSL

#include "shaders/octree/brick_octree.glsl"

// The largest channel of all leaves' radiance times opacity, W/(m² sr), as the bits of a float: what 1 in a brick
// represents.
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer BrickScale { uint brightest; };
layout(scalar) buffer RadianceVoxels {  // Not readonly: addresses are handed to functions.
    RadianceGrid grid;
    BrickNodes nodes;
    Bricks bricks;
    BrickScale scale;
} radianceVoxels;

// Radiance times opacity over the brightest, and opacity.
vec4 brickValue(uint brick, ivec3 texel) {
    return unpackUnorm4x8(radianceVoxels.bricks.data[brickIndex(brick, texel)]);
}
void storeBrickValue(uint brick, ivec3 texel, vec4 value) {
    radianceVoxels.bricks.data[brickIndex(brick, texel)] = packUnorm4x8(value);
}

// Trilinear in the brick of the node at the position; 0 where there is none.
vec4 sampleLevel(uint level, vec3 position, vec3 direction) {
    const RadianceGrid g = radianceVoxels.grid;
    const vec3 coordinates = (position - g.origin) / (g.voxelSize * float(1u << level));
    const ivec3 cell = ivec3(floor(coordinates));
    if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, ivec3(levelResolution(g, level)))))
        return vec4(0.0);
    const uint brick = findBrick(radianceVoxels.nodes, cell, g.levels - 1u - level);
    if (brick == NO_BRICK) return vec4(0.0);
    const vec3 inBrick = 2.0 * (coordinates - vec3(cell));
    const ivec3 corner = min(ivec3(inBrick), 1);
    const vec3 upper = inBrick - vec3(corner), lower = 1.0 - upper;
    vec4 sum = vec4(0.0);
    for (uint octant = 0u; octant < 8u; ++octant) {
        const ivec3 offset = octantOffset(octant);
        const vec3 weight = mix(lower, upper, vec3(offset));
        sum += weight.x * weight.y * weight.z * brickValue(brick, corner + offset);
    }
    return vec4(uintBitsToFloat(radianceVoxels.scale.brightest) * sum.rgb, sum.a);
}

uint startLevel(vec3 position, float dither) { return 0u; }

#endif
