// Voxels while they are rasterized: the moving average over a voxel's lit fragments of the radiance that they reflect
// (Arnebäck 2017, section 3.2.2), in half floats, in 64 bits that are compared and swapped. The upper 16 bits are 0
// without fragments, else 1 + the number of the lit ones.
#ifndef VOXRAY_LIT_VOXELS_GLSL
#define VOXRAY_LIT_VOXELS_GLSL

layout(scalar) buffer LitVoxels { uint64_t data[]; } litVoxels;

const uint64_t kKept = ~0ul;  // Voxels that are not rasterized again. No mean has these bits, which are not numbers.
const uint kMaxFragments = 0xfffdu;

struct LitVoxel {
    vec3 radiance;  // In units of the radiance grid.
    uint fragments;
    bool isOpaque;
};

LitVoxel unpackVoxel(uint64_t word) {
    const uvec2 halves = uvec2(uint(word), uint(word >> 32));
    const uint count = halves.y >> 16;
    return LitVoxel(vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y & 0xffffu).x), max(count, 1u) - 1u,
                    count != 0u);
}
uint64_t packVoxel(vec3 radiance, uint fragments) {
    const vec3 number = min(radiance, vec3(65504.0));
    return uint64_t(packHalf2x16(number.rg)) |
           (uint64_t(packHalf2x16(vec2(number.b, 0.0)) | (fragments + 1u) << 16) << 32);
}

// Index of a voxel in `region`, of whose voxels the first is grid.first and the last is below grid.resolution.
uint indexInRegion(ivec3 first, uvec3 end, ivec3 voxel) {
    const uvec3 size = end - uvec3(first), place = uvec3(voxel - first);
    return (place.z * size.y + place.y) * size.x + place.x;
}

// Merges a fragment into its voxel: one that no light reaches makes it opaque alone. The loop ends: each failed attempt
// is another invocation's success.
void mergeFragment(uint index, vec3 radiance, bool isLit) {
    uint64_t expected = 0ul;
    for (;;) {
        const LitVoxel v = unpackVoxel(expected);
        const float count = float(v.fragments);
        const uint64_t desired =
            isLit ? packVoxel((v.radiance * count + radiance) / (count + 1.0), min(v.fragments + 1u, kMaxFragments))
                  : packVoxel(vec3(0.0), 0u);
        const uint64_t current = atomicCompSwap(litVoxels.data[index], expected, desired);
        if (current == expected || current == kKept || (!isLit && current != 0ul)) return;
        expected = current;
    }
}

#endif
