// Initializes seeds in a uniform grid: each gets position and normal of the surface voxel nearest to its cell's center.
#include "passes/clusters/cluster_voxels/neighborhood.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Seeds { ClusterSeed data[]; } seeds;
layout(scalar) readonly buffer SeedGrid { uvec3 resolution; } seedGrid;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uvec3 size = seedGrid.resolution, cell = uvec3(i % size.x, (i / size.x) % size.y, i / (size.x * size.y));
    const vec3 width = vec3(push.grid.resolution) / vec3(size), center = (vec3(cell) + 0.5) * width;
    const ivec3 first = ivec3(ceil(vec3(cell) * width - 0.5)), last = ivec3(ceil(vec3(cell + 1u) * width - 0.5)) - 1;
    ClusterSeed seed = ClusterSeed(center, 0u, vec3(0.0, 0.0, 1.0));
    float minDistance2 = 1.0e30;
    for (BoxIterator it = voxelsInBox(first, last); nextVoxel(it);) {
        const vec3 position = vec3(it.voxel) + 0.5, offset = position - center;
        if (dot(offset, offset) >= minDistance2) continue;
        minDistance2 = dot(offset, offset);
        seed = ClusterSeed(position, 1u, normals.data[it.number]);
    }
    seeds.data[i] = seed;
}
