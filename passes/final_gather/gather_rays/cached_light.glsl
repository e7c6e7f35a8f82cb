// Light stored in a radiance cache (stored_light.glsl).
#include "passes/cache/radiance_cache.glsl"

StoredLight storedLight(vec3 position, vec3 normal) {
    const RadianceCacheGrid g = radianceCacheGrid.data;
    StoredLight stored = StoredLight(vec3(0.0), radianceCacheCellSize(g, radianceCacheLevel(g, position)), false);
    const uint slot = findRadianceCell(g, radianceCacheKey(g, position, normal));
    if (slot == NO_CELL) return stored;
    const vec4 mean = meanRadianceCell(g, slot);
    stored.irradiance = mean.rgb;
    stored.known = mean.w >= float(MIN_SAMPLES);
    return stored;
}
