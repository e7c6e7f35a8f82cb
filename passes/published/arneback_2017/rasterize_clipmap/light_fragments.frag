// Fragment callback: what a fragment reflects of each light that it is not in the shadow of, by one look at the light's
// shadow map (Arnebäck 2017, section 4.1.2, the fourth way), is merged into its voxel. voxelizer.fixedPointScale: 1 over
// the unit of radiance.
#include "passes/common/triangle_voxelizer/raster.glsl"
#include "passes/published/arneback_2017/rasterize_clipmap/lit_voxels.glsl"
#ifdef LEVELS
readonly buffer FirstVoxels { uint data[]; } firstVoxels;  // By level.
#define FIRST_VOXEL(level) firstVoxels.data[level]
#else
#define FIRST_VOXEL(level) 0u
#endif
#ifndef UNLIT
#include "shaders/lights/lights.glsl"
#include "shaders/lights/shadow_maps.glsl"

// Irradiance of a light on the side that faces it; 0 in shadow.
vec3 irradiance(ShadowLight l, SurfacePoint s) {
    const LightSample light = samplePunctual(sceneLights.data[l.light], s.position);
    const float side = dot(light.direction, s.geometricNormal) < 0.0 ? -1.0 : 1.0;
    const vec3 incident = light.irradiance * max(dot(side * s.normal, light.direction), 0.0);
    if (incident == vec3(0.0) || !passesShadowTest(l, s.position, side * s.geometricNormal)) return vec3(0.0);
    return incident;
}
#endif

void processFragment(TriangleFragment f) {
    if (!passesAlphaMask(f)) return;
    vec3 radiance = vec3(0.0);
#ifndef UNLIT
    const SurfacePoint s = surfacePoint(f.triangle, f.barycentrics);
    for (uint k = 0u; k < shadowLights.count; ++k) radiance += irradiance(shadowLights.data[k], s);
    const bool isLit = radiance != vec3(0.0);
    if (isLit) radiance *= diffuseAlbedo(sceneMaterials.data[s.material], s, 0.0) / PI * voxelizer.fixedPointScale;
#else
    const bool isLit = false;
#endif
    const VoxelGrid grid = DRAWN_GRID(f.level);
    mergeFragment(FIRST_VOXEL(f.level) + indexInRegion(grid.first, grid.resolution, f.voxel), radiance, isLit);
}
