// Irradiance of kept cells for lookups: one sample where a cell is lit, else none.
#include "passes/cache/hit_faces/hit_face.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Irradiance { vec4 data[]; } irradiance;  // W/m², by number; w: 1 where lit.

void main() {
    const uint slot = linearIndex();
    const RadianceCacheGrid g = radianceCacheGrid.data;
    if (slot >= g.capacity || radianceCacheKeys.data[slot] == 0ul) return;
    for (uint c = 0u; c < 4u; ++c) radianceCacheSums.data[4u * slot + c] = 0ul;
    const uint number = faceNumber(slot);
    if (number == NO_FACE || irradiance.data[number].w == 0.0) return;
    addRadianceSample(g, slot, irradiance.data[number].rgb);
}
