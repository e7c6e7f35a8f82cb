// Copies the words of uniform nodes of a coarser level to the entries of a table's level within them.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/octree.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint level; } push;

void main() {
    const uvec3 size = uvec3(octreeSize(push.level));
    const uint i = linearIndex();
    if (i >= size.x * size.y * size.z) return;
    const ivec3 voxel = ivec3(i % size.x, i / size.x % size.y, i / size.x / size.y);
    const uint parent = octree.table.data[octreeTableEntry(voxel >> 1, push.level + 1u)];
    if (isUniform(parent)) octree.table.data[octreeTableEntry(voxel, push.level)] = parent;
}
