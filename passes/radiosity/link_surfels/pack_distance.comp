// Packs with each surfel how near the surfaces are that are seen from its voxel: the mean inverse distance of the surfels there that look
// to the same side, as open or covered as it is. By each surfel's own a lookup would prefer those that see far, which in a gap are the
// brighter ones.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/packed_surfel.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer InverseDistancesAt { LargeFloats inverseDistances; };  // By slot, 1 / voxel.
layout(scalar) readonly buffer PackedAt { PackedSurfels packed_; };
readonly buffer Lists { uvec2 data[]; } lists;
layout(push_constant) uniform Push {
    uint voxels;
} push;

void main() {
    const uint list = linearIndex();
    if (list >= push.voxels) return;
    const uvec2 slots = lists.data[list];
    for (uint i = slots.x; i < slots.y; ++i) {
        const uvec2 own = packed_.data[i];
        const vec3 normal = normalOfSurfel(own.y);
        float sum = 0.0, weights = 0.0;
        for (uint j = slots.x; j < slots.y; ++j) {
            const uvec2 other = packed_.data[j];
            const float weight = dot(normal, normalOfSurfel(other.y));
            if (weight <= 0.0 || isCoveredSurfel(own.x) != isCoveredSurfel(other.x)) continue;
            sum += weight * inverseDistances.data[j];
            weights += weight;
        }
        packed_.data[i] = uvec2(own.x, withInverseDistance(own.y, sum / weights));
    }
}
