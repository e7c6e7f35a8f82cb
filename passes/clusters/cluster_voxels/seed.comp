// Seeds of clusters in a uniform grid of cells: each takes place and normal of the surface voxel in its cell that is nearest to the
// cell's center. A thread takes a cell.
#include "passes/clusters/cluster_voxels/neighbourhood.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Seeds { ClusterSeed data[]; } seeds;
layout(scalar) readonly buffer Cells { uvec3 along; } cells;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uvec3 cell = uvec3(i % cells.along.x, (i / cells.along.x) % cells.along.y, i / (cells.along.x * cells.along.y));
    const vec3 width = vec3(push.grid.resolution) / vec3(cells.along), center = (vec3(cell) + 0.5) * width;
    const ivec3 first = ivec3(ceil(vec3(cell) * width - 0.5)), last = ivec3(ceil(vec3(cell + 1u) * width - 0.5)) - 1;
    ClusterSeed seed = ClusterSeed(center, 0u, vec3(0.0, 0.0, 1.0));
    float nearest = 1.0e30;
    for (BoxWalk w = walkBox(first, last); nextVoxel(w);) {
        const vec3 place = vec3(w.voxel) + 0.5, away = place - center;
        if (dot(away, away) >= nearest) continue;
        nearest = dot(away, away);
        seed = ClusterSeed(place, 1u, normals.data[w.number]);
    }
    seeds.data[i] = seed;
}
