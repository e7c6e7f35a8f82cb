// The irradiance of each vertex, of `bounces` bounces: its direct light, and what the vertices that follow it reflect to it, or the
// cell in which its path ended. It goes into the vertex's own cell.
#include "passes/cache/update_radiance_cache/path_types.h"
#include "shaders/compute/linear_index.glsl"
#include "passes/cache/radiance_cache.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Vertices { PathVertex data[]; } vertices;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
buffer CellCounts {
    uint cells;
    uint lost;        // Samples whose cell found no slot.
    uint collisions;  // Slots that cells found taken by others.
} cellCounts;
layout(push_constant) uniform Push {
    uint count;
    uint bounces;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;

    // Up the path.
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
