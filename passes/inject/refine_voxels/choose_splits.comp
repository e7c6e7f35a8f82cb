// Keeps those voxels split whose split lowers the expected squared error. Levels: 0 has the children, 1 their parents.
//
// Two halves of the rays light the children independently of each other. Where E_a and E_b are their irradiances, A a
// child's area, and means are those over the parent's children, then
//     structure  sum of A (E_a - mean E_a) (E_b - mean E_b)   is what a single value for the parent errs by, squared;
//                noise has no part in it on average, since that of the halves is independent
//     noise      (sum of A (E_a - E_b)² - (sum of A) (mean E_a - mean E_b)²) / 4   is what splitting adds to the
//                variance of the mean of both halves, since each child has only a part of the rays
// both summed over faces and colors.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/refine_voxels/half_light.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Means { float data[]; } means;  // mean_irradiance.comp
layout(scalar) buffer Split { uint words[]; } split;           // Bits of the parents.
layout(scalar) buffer Count { uint value; } count;             // Of voxels that stay split.
layout(push_constant, scalar) uniform Push {
    uvec3 blocks;
    uint blockShift;   // Parents along an edge of a block, as a power of two.
    uint words;        // Of the parents' occupancy.
    float faceArea;    // Of a child, in faces of the coarsest voxels.
    float tolerance2;  // Squared error relative to the mean irradiance, times area in faces of the coarsest voxels.
} push;

// Sums over the faces of a parent, times area in faces of its children.
struct Disagreement {
    float structure;
    float noise;
};

void addFace(uint face, uint children[8], float voxelSize, inout Disagreement sum) {
    vec3 sumA = vec3(0.0), sumB = vec3(0.0);
    float area_ = 0.0, structure = 0.0, noise = 0.0;
    for (uint i = 0u; i < 8u; ++i) {
        if (children[i] == NO_VOXEL) continue;
        const HalfLight light = halfLight(6u * children[i] + face, voxelSize);
        // Lookups do not trust smaller ones alone either
        if (light.area < SMALL_FACE_AREA) continue;
        const vec3 difference = light.a - light.b;
        structure += dot(light.a, light.b) / light.area;
        noise += dot(difference, difference) / light.area;
        sumA += light.a;
        sumB += light.b;
        area_ += light.area;
    }
    if (area_ == 0.0) return;
    const vec3 difference = sumA - sumB;
    sum.structure += structure - dot(sumA, sumB) / area_;
    sum.noise += 0.25 * (noise - dot(difference, difference) / area_);
}

bool staysSplit(ivec3 parent) {
    const VoxelGrid grid = voxelLevels.data[0].grid;
    uint children[8];
    bool isAny = false;
    for (int i = 0; i < 8; ++i) {
        children[i] = voxelNumber(grid, 2 * parent + ivec3(i & 1, (i >> 1) & 1, i >> 2));
        isAny = isAny || children[i] != NO_VOXEL;
    }
    if (!isAny) return false;
    Disagreement sum = Disagreement(0.0, 0.0);
    for (uint face = 0u; face < 6u; ++face) addFace(face, children, grid.voxelSize, sum);
    const float gain = sum.structure - sum.noise;
    const uvec3 block = uvec3(parent) >> push.blockShift;
    const float mean2 = means.data[(block.z * push.blocks.y + block.y) * push.blocks.x + block.x];
    return gain * push.faceArea > push.tolerance2 * mean2;
}

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const VoxelGrid parents = voxelLevels.data[1].grid;
    const uvec3 first = wordCoordinates(parents, word);
    uint kept = 0u;
    for (uint bits = split.words[word]; bits != 0u; bits &= bits - 1u)
        if (staysSplit(ivec3(first + uvec3(findLSB(bits), 0u, 0u)))) kept |= bits & -bits;
    split.words[word] = kept;
    if (kept != 0u) atomicAdd(count.value, uint(bitCount(kept)));
}
