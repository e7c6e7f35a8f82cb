// Sets the bits of the voxels in a region, given as boxes in wrapped coordinates. gl_WorkGroupID.z is the box.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

struct VoxelBox {
    ivec3 first;
    uvec3 size;
};
layout(scalar) readonly buffer Boxes { VoxelBox data[]; } boxes;
buffer Region { uint words[]; } region;
layout(push_constant, scalar) uniform Push {
    uint rows;  // Of the grid's window, along y.
    uint wordsPerRow;
} push;

void main() {
    const uvec3 first = uvec3(boxes.data[gl_WorkGroupID.z].first), size = boxes.data[gl_WorkGroupID.z].size;
    const uint firstWord = first.x / 32u, words = (first.x + size.x - 1u) / 32u - firstWord + 1u;
    const uint i = linearIndex();
    if (i >= words * size.y * size.z) return;
    const uint word = firstWord + i % words;
    const uint y = first.y + i / words % size.y, z = first.z + i / words / size.y;

    // The word's bits from the box's first to its last
    const uint from = max(first.x, 32u * word) - 32u * word,
               to = min(first.x + size.x, 32u * word + 32u) - 32u * word - 1u;
    const uint bits = (0xffffffffu << from) & (0xffffffffu >> (31u - to));
    atomicOr(region.words[(z * push.rows + y) * push.wordsPerRow + word], bits);
}
