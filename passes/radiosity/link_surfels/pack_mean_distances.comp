// Packs with each surfel the mean inverse distance over its voxel's surfels of similar normals and equal occlusion.
// With a surfel's own distance, lookups in a gap would prefer surfels that see far, which are the brighter ones.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/packed_surfel.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer InverseDistancesRef { LargeFloats inverseDistances; };  // By sorted surfel, 1/voxel.
layout(scalar) readonly buffer PackedRef { PackedSurfels packed_; };
readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;
layout(push_constant) uniform Push {
    uint voxels;
} push;

void main() {
    const uint list = linearIndex();
    if (list >= push.voxels) return;
    const uvec2 range = surfelRanges.data[list];
    for (uint i = range.x; i < range.y; ++i) {
        const uvec2 surfel = packed_.data[i];
        const vec3 normal = unpackNormal(surfel.y);
        float sum = 0.0, weights = 0.0;
        for (uint j = range.x; j < range.y; ++j) {
            const uvec2 neighbor = packed_.data[j];
            const float weight = dot(normal, unpackNormal(neighbor.y));
            if (weight <= 0.0 || isOccludedSurfel(surfel.x) != isOccludedSurfel(neighbor.x)) continue;
            sum += weight * inverseDistances.data[j];
            weights += weight;
        }
        packed_.data[i] = uvec2(surfel.x, packInverseDistance(surfel.y, sum / weights));
    }
}
