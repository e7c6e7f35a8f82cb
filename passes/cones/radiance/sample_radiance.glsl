// Radiance voxels at any footprint, interpolated between levels: for cones in free steps, tests and benchmarks.
#ifndef VOXRAY_SAMPLE_RADIANCE_GLSL
#define VOXRAY_SAMPLE_RADIANCE_GLSL

#include "passes/cones/radiance/radiance_voxels.glsl"

// What a ray along `direction` (unit) sees in a cube of side `footprint` (m) around `position`: rgb, the radiance that
// surfaces there send against `direction`, times their opacity, W/(m² sr); a, the opacity over one footprint's length:
// 0 in empty space, above 1 where surfaces occlude each other. Linear in space and, by opacity per length, between
// levels: a surface is equally opaque in both.
vec4 sampleRadiance(vec3 position, float footprint, vec3 direction) {
    const float top = float(radianceVoxels.grid.levels - 1u);
    const float level = clamp(log2(footprint / radianceVoxels.grid.voxelSize), 0.0, top);
    const uint finer = uint(level);
    const float coarserWeight = level - float(finer);
    vec4 sum = sampleLevel(finer, position, direction) * (1.0 - coarserWeight) * (footprint / radianceVoxelSize(finer));
    if (coarserWeight > 0.0)
        sum +=
            sampleLevel(finer + 1u, position, direction) * coarserWeight * (footprint / radianceVoxelSize(finer + 1u));
    return sum;
}

#endif
