// Gives a face on which nothing was measured the mean irradiance of the same face of the voxels around it, over its own
// unoccluded area. Where those know nothing either it stays unknown.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Measured { uint data[]; } measured;  // Areas of faces that were measured; 0: unknown.
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

// Of the same face of the 26 voxels around a voxel.
FaceLight around(ivec3 voxel, uint face) {
    FaceLight sum = FaceLight(vec3(0.0), vec3(0.0), 0.0);
    for (int i = 0; i < 27; ++i) {
        const uint other = voxelNumber(push.grid, voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1);
        if (i == 13 || other == NO_VOXEL) continue;
        const uint at = 6u * other + face;
        const float known = areaOf(measured.data[at / 2u], at);
        if (known == 0.0) continue;
        sum.direct += loadFlux(direct, at);
        sum.indirect += loadFlux(indirect, at);
        sum.area += known;
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
            const float own = unoccluded(m, 2u * axis + k);
            light[k] = FaceLight(loadFlux(direct, face), loadFlux(indirect, face), areaOf(measured.data[pair], k));
            if (light[k].area > 0.0 || own == 0.0) continue;
            const FaceLight sum = around(voxel, 2u * axis + k);
            if (sum.area == 0.0) continue;
            light[k] = FaceLight(sum.direct * (own / sum.area), sum.indirect * (own / sum.area), own);
            isFilled = true;
        }
        // Other threads may read the known face of the pair meanwhile: packing it again gives the same bits.
        if (!isFilled) continue;
        storeFlux(direct, pair, light[0].direct, light[1].direct);
        storeFlux(indirect, pair, light[0].indirect, light[1].indirect);
        area.data[pair] = packAreas(light[0].area, light[1].area);
    }
}

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uint row = word / push.grid.wordsPerRow, rows = heldVoxels(push.grid).y;
    const uvec3 slot = uvec3(32u * (word % push.grid.wordsPerRow), row % rows, row / rows);
    uint number = voxelRank.before[word];
    for (uint bits = voxelOccupancy.words[word]; bits != 0u; bits &= bits - 1u)
        fill(ivec3(voxelInSlot(push.grid, slot + uvec3(findLSB(bits), 0u, 0u))), number++);
}
