// Irradiance of patches averaged with those at the same faces of the sides round them that look into the same space, by binomial
// weights (Cosin and Patow 2022, section 4.4, whose filter also crosses walls). A thread takes a side; SEEN: one that is listed.
#include "passes/clusters/gather_clusters/which_sides.glsl"
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchValues { vec3 data[]; };
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;  // Of voxels.
readonly buffer FirstNeighbour { uint data[]; } firstNeighbour;
layout(scalar) readonly buffer NeighboursAt { LargeUints neighbours; };
layout(scalar) readonly buffer GatheredAt { PatchValues gathered; };
layout(scalar) readonly buffer FilteredAt { PatchValues filtered; };
layout(push_constant) uniform Push { uint count; } push;

// 1 2 1 along each axis.
float weightAt(vec3 between) {
    const vec3 weight = 2.0 - abs(between);
    return weight.x * weight.y * weight.z;
}

void addPatches(SurfaceSide side, float weight, inout vec4 sum[6]) {
    uint at = side.firstPatch;
    for (uint face = 0u; face < 6u; ++face) {
        if (!hasPatch(side, face)) continue;
        const vec3 irradiance = gathered.data[at++];
#ifdef LIT_ALONE
        if (all(equal(irradiance, vec3(0.0)))) continue;
#endif
        sum[face] += weight * vec4(irradiance, 1.0);
    }
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint number = sideNumber(i);
    const SurfaceSide side = sides.data[number];
    vec4 sum[6];
    for (uint face = 0u; face < 6u; ++face) sum[face] = vec4(0.0);
    addPatches(side, weightAt(vec3(0.0)), sum);
    const vec3 center = vec3(coordinates.data[side.voxel]);
    for (uint k = firstNeighbour.data[number]; k < firstNeighbour.data[number + 1u]; ++k) {
        const uint other = neighbours.data[k];
        if (other == NO_SIDE) continue;
        const SurfaceSide near = sides.data[other];
        addPatches(near, weightAt(vec3(coordinates.data[near.voxel]) - center), sum);
    }
    uint at = side.firstPatch;
    for (uint face = 0u; face < 6u; ++face)
        if (hasPatch(side, face)) filtered.data[at++] = sum[face].w > 0.0 ? sum[face].rgb / sum[face].w : vec3(0.0);
}
