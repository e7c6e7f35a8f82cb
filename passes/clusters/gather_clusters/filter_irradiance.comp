// Filters the irradiance of patches by binomial weights over the same face of neighboring surface groups (Cosin and
// Patow 2022, section 4.4; the paper's filter also crosses walls). LIT_ONLY: unlit patches are excluded.
#include "passes/clusters/gather_clusters/listed_groups.glsl"
#include "passes/clusters/neighbors.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchValues { vec3 data[]; };
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstNeighbor { uint data[]; } firstNeighbor;
layout(scalar) readonly buffer NeighborsRef { LargeUints neighbors; };
layout(scalar) readonly buffer GatheredRef { PatchValues gathered; };
layout(scalar) readonly buffer FilteredRef { PatchValues filtered; };
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
} push;

// Weights are 1 2 1 along each axis.
float binomialWeight(vec3 offset) {
    const vec3 weight = 2.0 - abs(offset);
    return weight.x * weight.y * weight.z;
}

void addPatches(SurfaceGroup group, float weight, inout vec4 sums[6]) {
    uint patchNumber = group.firstPatch;
    for (uint face = 0u; face < 6u; ++face) {
        if (!hasPatch(group, face)) continue;
        const vec3 irradiance = gathered.data[patchNumber++];
#ifdef LIT_ONLY
        if (all(equal(irradiance, vec3(0.0)))) continue;
#endif
        sums[face] += weight * vec4(irradiance, 1.0);
    }
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint number = groupIndex(i);
    const SurfaceGroup group = groups.data[number];
    vec4 sums[6];
    for (uint face = 0u; face < 6u; ++face) sums[face] = vec4(0.0);
    addPatches(group, binomialWeight(vec3(0.0)), sums);
    for (uint k = firstNeighbor.data[number]; k < firstNeighbor.data[number + 1u]; ++k) {
        const uint code = byteOf(neighbors.data[k / 4u], k);
        addPatches(groups.data[neighborIndex(push.grid, group, code)], binomialWeight(vec3(neighborOffset(code))),
                   sums);
    }
    uint patchNumber = group.firstPatch;
    for (uint face = 0u; face < 6u; ++face)
        if (hasPatch(group, face))
            filtered.data[patchNumber++] = sums[face].w > 0.0 ? sums[face].rgb / sums[face].w : vec3(0.0);
}
