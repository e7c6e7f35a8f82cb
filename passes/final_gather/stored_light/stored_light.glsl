// Lookups of stored irradiance, in one of four storages. Host: passes/final_gather/stored_light/stored_light.h.
#ifndef VOXRAY_STORED_LIGHT_GLSL
#define VOXRAY_STORED_LIGHT_GLSL

#if defined(STORED_IN_VOXELS)
#include "shaders/voxels/face_irradiance.glsl"
#include "shaders/voxels/voxel_levels.glsl"
#elif defined(STORED_IN_MERGED_VOXELS)
#include "passes/final_gather/merged_voxels/irradiance_tree.glsl"
#elif defined(STORED_IN_RADIANCE_CACHE)
#include "passes/cache/radiance_cache.glsl"
#elif defined(STORED_IN_HIT_FACES)
#include "passes/cache/hit_faces/hit_face_light.glsl"
#endif

struct StoredLight {
    vec3 irradiance;  // W/m²
    float cellSize;   // Edge of the cell over which it is averaged, m.
    bool known;       // False where no light is stored.
};

// The value stored for a surface point, for the side of the surface that the unit normal points to.
StoredLight storedLight(vec3 position, vec3 normal) {
    StoredLight stored = StoredLight(vec3(0.0), 0.0, false);
#if defined(STORED_IN_VOXELS)
    const VoxelGrid g = gridAt(position);
    stored.irradiance = irradianceAt(g, position, normal, stored.known);
    stored.cellSize = g.voxelSize;
#elif defined(STORED_IN_MERGED_VOXELS)
    stored.irradiance = irradianceAt(irradianceTree.grid.voxels, position, normal, stored.known);
    stored.cellSize = irradianceTree.grid.voxels.voxelSize;
#elif defined(STORED_IN_RADIANCE_CACHE)
    const RadianceCacheGrid g = radianceCacheGrid.data;
    stored.cellSize = radianceCacheCellSize(g, radianceCacheLevel(g, position));
    const uint slot = findRadianceCell(g, radianceCacheKey(g, position, normal));
    if (slot == NO_CELL) return stored;
    const vec4 mean = meanRadianceCell(g, slot);
    stored.irradiance = mean.rgb;
    stored.known = mean.w >= float(MIN_SAMPLES);
#elif defined(STORED_IN_HIT_FACES)
    stored.irradiance = hitFaceIrradianceAt(position, normal, stored.known);
    stored.cellSize = gridAt(position).voxelSize;
#endif
    return stored;
}

#endif
