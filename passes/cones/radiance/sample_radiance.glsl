// Radiance voxels at any footprint, interpolated between levels: for cones in free steps, tests and benchmarks.
#ifndef VOXRAY_SAMPLE_RADIANCE_GLSL
#define VOXRAY_SAMPLE_RADIANCE_GLSL

#include "passes/cones/radiance/radiance_voxels.glsl"

// The two levels whose voxels are nearest to `footprint` (m) in size, interpolated at `position`: radiance times opacity,
// and opacity, for a ray along `direction` (unit). @param perLength scales both levels' opacity to one footprint's length
vec4 sampleLevels(vec3 position, float footprint, vec3 direction, bool perLength) {
    const float top = float(radianceVoxels.grid.levels - 1u);
    const float level = clamp(log2(footprint / radianceVoxels.grid.voxelSize), 0.0, top);
    const uint finer = uint(level);
    const float coarserWeight = level - float(finer);
    const vec2 lengths = perLength ? footprint / vec2(radianceVoxelSize(finer), radianceVoxelSize(finer + 1u)) : vec2(1.0);
    vec4 sum = sampleLevel(finer, position, direction) * (1.0 - coarserWeight) * lengths.x;
    if (coarserWeight > 0.0) sum += sampleLevel(finer + 1u, position, direction) * coarserWeight * lengths.y;
    return sum;
}

// What a ray along `direction` (unit) sees in a cube of side `footprint` (m) around `position`: rgb, the radiance that
// surfaces there send against `direction`, times their opacity, W/(m² sr); a, the opacity over one footprint's length:
// 0 in empty space, above 1 where surfaces occlude each other. Linear in space and, by opacity per length, between
// levels: a surface is equally opaque in both.
vec4 sampleRadiance(vec3 position, float footprint, vec3 direction) {
    return sampleLevels(position, footprint, direction, true);
}

#endif
