// Prefiltered radiance where a ray hit a surface: visibility comes from the ray, radiance from voxels.
#ifndef VOXRAY_RADIANCE_AT_HIT_GLSL
#define VOXRAY_RADIANCE_AT_HIT_GLSL

#include "passes/cones/radiance/radiance_voxels.glsl"

// Radiance, W/(m² sr), that surfaces in the voxel of `level` around a hit send to the side that the unit `normal` points
// to. By the squared normal, as voxels divide a facet's area among their faces: what faces elsewhere counts little.
// Areas are sampled, so a sliver may have none: then the next coarser level is read. A voxel whose surfaces face the
// other way alone has left out a dark face (surface_radiance.glsl, isBackOfLit).
vec3 radianceAtHit(vec3 position, vec3 normal, uint level) {
    const RadianceGrid g = radianceVoxels.grid;
    const vec3 toSurface = -normal * abs(normal);
    for (; level < g.levels; ++level) {
        const float voxel = radianceVoxelSize(level);
        const vec3 center = g.origin + (floor((position - g.origin) / voxel) + 0.5) * voxel;
        const vec4 value = sampleLevel(level, center, toSurface);
        if (value.a > 0.0) return value.rgb / value.a;
        if (sampleLevel(level, center, -toSurface).a > 0.0) return vec3(0.0);
    }
    return vec3(0.0);
}

// The level of the voxels that a cone reads at a hit, `distance_` metres from its start: at most half as wide as the
// cone, as in radiance_cone.glsl, and not finer than the layout has them there.
uint levelAtHit(vec3 position, float width, float distance_, vec2 dither) {
    const RadianceGrid g = radianceVoxels.grid;
    const float level = log2(max(0.5 * width * distance_ / g.voxelSize, 1e-6)) + dither.y - 0.5;
    return max(uint(clamp(level, 0.0, float(g.levels - 1u))), startLevel(position, dither.x));
}

#endif
