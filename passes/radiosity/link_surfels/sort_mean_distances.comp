// Mean inverse distances by sorted surfel, from the sums that are kept by surfel (mean_inverse_distance.comp).
#include "passes/radiosity/link_surfels/link_hit.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer InverseSumsRef { LargeUints inverseSums; };
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
layout(scalar) readonly buffer InverseDistancesRef { LargeFloats inverseDistances; };  // 1/voxel.
layout(push_constant) uniform Push {
    uint surfelCount;
    uint raysPerSurfel;
} push;

void main() {
    const uint surfel = linearIndex();
    if (surfel >= push.surfelCount) return;
    const uint sortedIndex = sortedIndices.data[surfel];
    if (sortedIndex == 0xffffffffu) return;
    const float units = inverseDistanceUnits(push.raysPerSurfel) * float(push.raysPerSurfel);
    inverseDistances.data[sortedIndex] = float(inverseSums.data[surfel]) / units;
}
