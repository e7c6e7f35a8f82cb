// Adds the irradiance of each vertex to its cell: direct light, light that the next `bounces` vertices of its path
// reflect to it, and light of the cell in which the path ended.
#include "passes/cache/update_radiance_cache/path_types.h"
#include "shaders/compute/linear_index.glsl"
#include "passes/cache/radiance_cache.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Vertices { CachePathVertex data[]; } vertices;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
buffer CellCounts {
    uint cells;
    uint lost;        // Samples whose cell found no slot.
    uint collisions;  // Slots with other keys that insertions probed.
} cellCounts;
layout(push_constant) uniform Push {
    uint count;
    uint bounces;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;

    // Sum light along the path
    vec3 irradiance = direct.data[i].rgb + vertices.data[i].fromCache, throughput = vec3(1.0);
    uint v = i;
    for (uint bounce = 0u; bounce < push.bounces; ++bounce) {
        v = vertices.data[v].next;
        if (v == NO_VERTEX) break;
        throughput *= surfels.data[v].reflectance;
        irradiance += throughput * (direct.data[v].rgb + vertices.data[v].fromCache);
    }

    const RadianceCacheGrid g = radianceCacheGrid.data;
    bool isNew;
    uint collisions;
    const uint slot = insertRadianceCell(g, packUint2x32(vertices.data[i].key), isNew, collisions);
    if (isNew) atomicAdd(cellCounts.cells, 1u);
    if (collisions > 0u) atomicAdd(cellCounts.collisions, collisions);
    if (slot == NO_CELL)
        atomicAdd(cellCounts.lost, 1u);
    else
        addRadianceSample(g, slot, irradiance);
}
