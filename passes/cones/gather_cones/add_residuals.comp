// Adds to each cone that went on as a path what its path brings, less what the cone read in voxels, over the probability
// that it went on.
#include "passes/cones/gather_cones/chosen_cones.glsl"
#include "passes/path_trace/path_streams/path_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sums { PathSums data[]; } sums;
layout(scalar) buffer Light { vec4 data[]; } light;  // By cone of the batch: its radiance times pi.

void main() {
    const uint i = linearIndex();
    if (i >= push.batchCones || !isChosen(i)) return;
    light.data[i].rgb += (sums.data[i].irradiance - light.data[i].rgb) / push.probability;
}
