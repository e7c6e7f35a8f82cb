// Writes the irradiance of surfels to their voxels, averages weighted by area.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/voxel_accumulator.glsl"
#include "shaders/voxels/voxel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Irradiance { vec4 data[]; } irradiance;  // W/m²
layout(push_constant) uniform Push {
    uint count;
    float scale;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count || surfels.data[i].voxel == NO_VOXEL || surfels.data[i].area == 0.0) return;
#if WRITE == WRITE_AVERAGE
    const float weight = surfels.data[i].area;
#else
    const float weight = 1.0;
#endif
    writeIrradiance(surfels.data[i].voxel, surfels.data[i].normal, irradiance.data[i].rgb, weight, push.scale);
}
