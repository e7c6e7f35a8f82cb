// Prefiltered radiance where a ray hit a surface: visibility comes from the ray, radiance from voxels.
#ifndef VOXRAY_RADIANCE_AT_HIT_GLSL
#define VOXRAY_RADIANCE_AT_HIT_GLSL

#include "passes/cones/radiance/radiance_voxels.glsl"
#include "shaders/voxels/small_areas.glsl"

// Radiance, W/(m² sr), that surfaces in the voxel of `level` around a hit send to the side that the unit `normal` points
// to. By the squared normal, as voxels divide a facet's area among their faces: what faces elsewhere counts little. A
// voxel whose surfaces face the other way alone has left out a dark face (surface_radiance.glsl, isBackOfLit). Where
// there is little surface the 26 adjacent voxels count, as in irradianceAt() of shaders/voxels/face_lookup.glsl.
vec3 radianceAtHit(vec3 position, vec3 normal, uint level) {
    const RadianceGrid g = radianceVoxels.grid;
    const vec3 toSurface = -normal * abs(normal);
    const float voxel = radianceVoxelSize(level);
    const vec3 center = g.origin + (floor((position - g.origin) / voxel) + 0.5) * voxel;
    vec4 sum = sampleLevel(level, center, toSurface);
    if (sum.a == 0.0 && sampleLevel(level, center, -toSurface).a > SMALL_FACE_AREA) return vec3(0.0);
    for (int i = 0; i < 27 && sum.a < SMALL_FACE_AREA; ++i)
        if (i != 13) sum += sampleLevel(level, center + voxel * (vec3(i % 3, (i / 3) % 3, i / 9) - 1.0), toSurface);
    return sum.a > MIN_FACE_AREA ? sum.rgb / sum.a : vec3(0.0);
}

#endif
