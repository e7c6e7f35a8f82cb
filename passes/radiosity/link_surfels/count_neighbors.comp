// Counts the neighbors of each surfel, by node, and of all.
#include "passes/radiosity/link_surfels/neighborhood.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

writeonly buffer Counts { uint data[]; } counts;
buffer Total { uint below256, above256; } total;  // Sums of the counts' remainders by 256, and of their quotients.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    float radius;  // m, at most a voxel.
} push;

void main() {
    const uint surfel = linearIndex();
    if (surfel >= push.count) return;
    const uint count = listNeighbors(push.grid, push.radius, surfel, false, 0u);
    counts.data[nodeOf(surfel)] = count;
    atomicAdd(total.below256, count & 255u);
    if (count >= 256u) atomicAdd(total.above256, count >> 8);
}
