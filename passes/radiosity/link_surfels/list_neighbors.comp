// Lists the neighbors of each surfel, by its count's prefix sum. BY_SURFEL: also sets the places that a list has.
#define WRITES
#include "passes/radiosity/link_surfels/neighborhood.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Begins { uint data[]; } begins;
writeonly buffer Ranges { uvec2 data[]; } ranges;
#ifdef BY_SURFEL
writeonly buffer Places { uint data[]; } places;
#endif
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    float radius;  // m, at most a voxel.
} push;

void main() {
    const uint surfel = linearIndex();
    if (surfel >= push.count) return;
    const uint node = nodeOf(surfel), begin = begins.data[node];
    const uint count = listNeighbors(push.grid, push.radius, surfel, true, begin);
    ranges.data[node] = uvec2(begin, begin + count);
#ifdef BY_SURFEL
    places.data[node] = count;
#endif
}
