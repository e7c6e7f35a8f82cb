// Writes the values of an octree's leaves: radiance and opacity of the surfaces.
#include "passes/cones/filter_voxels/svo_changed.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/surface_radiance.glsl"
layout(local_size_x = 64) in;

readonly buffer Leaves { uint cell[]; } leaves;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float emission;
    uint firstLeaf;
    uint count;
} push;

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.count) return;
    const uint voxel = voxelNumber(push.grid, unpackCell(leaves.cell[leaf]));
    const uint node = push.firstLeaf + leaf;
    for (uint face = 0u; face < radianceVoxels.grid.directions; ++face)
        replaceOctreeValue(node, face, voxelRadiance(push.grid, voxel, face, push.emission));
}
