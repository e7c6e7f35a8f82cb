// Where a list of voxels stands in an octree: each one's leaf, and the level at which a cone from its center would start.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Queries { ivec3 voxel[]; } queries;
layout(scalar) writeonly buffer Answers { uvec2 data[]; } answers;
layout(push_constant) uniform Push {
    uint count;
    uint firstLeaf;  // Its node.
} push;

#define NO_LEAF 0xffffffffu

// Index of a voxel's leaf among the leaves; NO_LEAF where the voxel is empty or outside the grid.
uint octreeLeaf(ivec3 voxel) {
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(octree.shape.resolution)))) return NO_LEAF;
    const uint node = octreeChild(octreeWord(voxel >> 1, 1u), octantOf(voxel));
    return node == NO_NODE ? NO_LEAF : node - push.firstLeaf;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const ivec3 voxel = queries.voxel[i];
    const vec3 center = radianceVoxels.grid.origin + radianceVoxels.grid.voxelSize * (vec3(voxel) + 0.5);
    answers.data[i] = uvec2(octreeLeaf(voxel), startLevel(center, 0.5));
}
