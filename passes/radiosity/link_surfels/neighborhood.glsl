// The neighbors of a surfel: surfels in the 27 voxels around it within a radius, of similar normals and equal occlusion.
// WRITES: writes them as pairs. BY_SURFEL: nodes are surfels by SortedSurfel::index, else sorted ones.
#ifndef VOXRAY_NEIGHBORHOOD_GLSL
#define VOXRAY_NEIGHBORHOOD_GLSL

#include "passes/surfels/neighbors.glsl"
#include "passes/surfels/sorted_surfels.glsl"
#include "passes/surfels/surfel_bias.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer SortedRef { SortedSurfelWords sorted; };
readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;
#ifdef WRITES
layout(scalar) readonly buffer PairsRef { NeighborPairs pairs; };
#endif

uint nodeOf(uint surfel, SortedSurfel s) {
#ifdef BY_SURFEL
    return s.index;
#else
    return surfel;
#endif
}

uint nodeOf(uint surfel) {
    SortedSurfelWords words = sorted;
    return nodeOf(surfel, sortedSurfel(words, surfel));
}

// Counts the neighbors of a sorted surfel. `radius`: m, at most a voxel. `writes`: writes their pairs from `begin` on.
uint listNeighbors(VoxelGrid grid, float radius, uint surfel, bool writes, uint begin) {
    SortedSurfelWords words = sorted;  // Loop-invariant load, which compilers do not hoist.
    const SortedSurfel center = sortedSurfel(words, surfel);
    const ivec3 voxel = voxelAt(grid, center.position);
    const float squaredRadius = radius * radius;
    uint count = 0u;
    for (int i = 0; i < 27; ++i) {
        const uint list = voxelNumber(grid, voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1);
        if (list == NO_VOXEL) continue;
        const uvec2 range = surfelRanges.data[list];
        for (uint j = range.x; j < range.y; ++j) {
            const SortedSurfel neighbor = sortedSurfel(words, j);
            const vec3 offset = neighbor.position - center.position;
            const float distanceSquared = dot(offset, offset);
            if (j == surfel || distanceSquared >= squaredRadius) continue;
            if (dot(neighbor.normal, center.normal) <= 0.0) continue;
            if (((neighbor.id ^ center.id) & VOXRAY_OCCLUDED) != 0u) continue;  // Light in a gap is independent.
#ifdef WRITES
            if (writes) {
                const float bias = surfelBias(center.position, center.normal, neighbor.position, neighbor.normal);
                pairs.data[begin + count] = packNeighbor(nodeOf(j, neighbor), bias, distanceSquared / squaredRadius);
            }
#endif
            ++count;
        }
    }
    return count;
}

#endif
