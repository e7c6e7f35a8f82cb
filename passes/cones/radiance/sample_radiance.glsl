// Radiance voxels at any footprint: what cones in free steps, tests and benchmarks ask of every layout.
#ifndef VOXRAY_SAMPLE_RADIANCE_GLSL
#define VOXRAY_SAMPLE_RADIANCE_GLSL

#include "passes/cones/radiance/radiance_voxels.glsl"

// What a ray along `direction` (unit) meets in a cube of side `footprint` (m) round `position`: rgb, the radiance that surfaces
// there send against `direction`, times their opacity, W/(m² sr); a, the opacity that a beam meets over one footprint's length: 0
// where there is nothing; above 1 where surfaces hide each other. Linear in space and between levels, by density along the ray: a
// surface is as opaque in both.
vec4 sampleRadiance(vec3 position, float footprint, vec3 direction) {
    const float top = float(radianceVoxels.grid.levels - 1u);
    const float level = clamp(log2(footprint / radianceVoxels.grid.voxelSize), 0.0, top);
    const uint finer = uint(level);
    const float part = level - float(finer);
    vec4 met = sampleLevel(finer, position, direction) * (1.0 - part) * (footprint / radianceVoxelSize(finer));
    if (part > 0.0)
        met += sampleLevel(finer + 1u, position, direction) * part * (footprint / radianceVoxelSize(finer + 1u));
    return met;
}

#endif
