// Sets faces of unknown irradiance to the mean irradiance of the same face of the 26 adjacent voxels, over their own
// unoccluded area. Where those are unknown as well, the face remains unknown.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Measured { uint data[]; } measured;  // Areas before; 0: unknown.
layout(scalar) buffer Area { uint data[]; } area;
layout(scalar) buffer DirectRef { LargeUints direct; };
layout(scalar) buffer IndirectRef { LargeUints indirect; };
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint words;
} push;

struct FaceLight {
    vec3 direct;    // W
    vec3 indirect;  // W
    float area;     // In units of a voxel's face.
};

// Sum over the same face of the 26 adjacent voxels.
FaceLight sumNeighbors(ivec3 voxel, uint face) {
    FaceLight sum = FaceLight(vec3(0.0), vec3(0.0), 0.0);
    for (int i = 0; i < 27; ++i) {
        const uint neighbor = voxelNumber(push.grid, voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1);
        if (i == 13 || neighbor == NO_VOXEL) continue;
        const uint index = 6u * neighbor + face;
        const float area_ = areaOf(measured.data[index / 2u], index);
        if (area_ == 0.0) continue;
        sum.direct += loadFlux(direct, index);
        sum.indirect += loadFlux(indirect, index);
        sum.area += area_;
    }
    return sum;
}

void fill(ivec3 voxel, uint number) {
    const VoxelMaterial m = voxelMaterial(number);
    for (uint axis = 0u; axis < 3u; ++axis) {
        const uint pair = 3u * number + axis;
        FaceLight light[2];
        bool isFilled = false;
        for (uint k = 0u; k < 2u; ++k) {
            const uint face = 2u * pair + k;
            const float unoccludedArea = unoccluded(m, 2u * axis + k);
            light[k] = FaceLight(loadFlux(direct, face), loadFlux(indirect, face), areaOf(measured.data[pair], k));
            if (light[k].area > 0.0 || unoccludedArea == 0.0) continue;
            const FaceLight sum = sumNeighbors(voxel, 2u * axis + k);
            if (sum.area == 0.0) continue;
            const float scale = unoccludedArea / sum.area;
            light[k] = FaceLight(sum.direct * scale, sum.indirect * scale, unoccludedArea);
            isFilled = true;
        }
        // Other invocations may read the pair's known face at the same time: packing it again gives the same bits
        if (!isFilled) continue;
        storeFlux(direct, pair, light[0].direct, light[1].direct);
        storeFlux(indirect, pair, light[0].indirect, light[1].indirect);
        area.data[pair] = packAreas(light[0].area, light[1].area);
    }
}

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uvec3 first = wordCoordinates(push.grid, word);
    uint number = voxelRank.before[word];
    for (uint bits = voxelOccupancy.words[word]; bits != 0u; bits &= bits - 1u)
        fill(ivec3(unwrappedVoxel(push.grid, first + uvec3(findLSB(bits), 0u, 0u))), number++);
}
