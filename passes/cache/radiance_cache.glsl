// Irradiance in hashed cells: a hash table with open addressing and linear probing, whose values are fixed-point sums.
// Host: passes/cache/radiance_cache.h.
#ifndef VOXRAY_RADIANCE_CACHE_GLSL
#define VOXRAY_RADIANCE_CACHE_GLSL

#include "passes/cache/radiance_cache_types.h"
#include "shaders/scene/sampling.glsl"

layout(scalar) readonly buffer RadianceCacheGridRef { RadianceCacheGrid data; } radianceCacheGrid;
layout(scalar) coherent buffer RadianceCacheKeys { uint64_t data[]; } radianceCacheKeys;  // 0: an empty slot.
// Four words a slot: red, green and blue irradiance, and the number of samples.
layout(scalar) buffer RadianceCacheSums { uint64_t data[]; } radianceCacheSums;

#define NO_CELL 0xffffffffu

// Level of the cell that contains a position.
uint radianceCacheLevel(RadianceCacheGrid g, vec3 position) {
    const float largest = g.cellSize * max(distance(position, g.camera), 1e-20);
    return uint(clamp(ceil(log2(g.edge / largest)), 0.0, float(RADIANCE_CACHE_LEVELS - 1u)));
}

// Edge of the cells of a level, m.
float radianceCacheCellSize(RadianceCacheGrid g, uint level) { return ldexp(g.edge, -int(level)); }

// Bin of a unit normal in a cube map of normalBins² bins a face.
uint radianceCacheNormalBin(RadianceCacheGrid g, vec3 normal) {
    const vec3 size = abs(normal);
    const uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    const vec2 onFace = vec2(normal[(axis + 1u) % 3u], normal[(axis + 2u) % 3u]) / max(size[axis], 1e-20);
    const uvec2 bin = min(uvec2((0.5 + 0.5 * onFace) * float(g.normalBins)), uvec2(g.normalBins - 1u));
    const uint face = 2u * axis + (normal[axis] < 0.0 ? 1u : 0u);
    return (face * g.normalBins + bin.y) * g.normalBins + bin.x;
}

// Key of a cell: 17 bits for each coordinate (positions outside of the grid's cube wrap around), 5 for the level plus
// 1, so that no key is 0, and 8 for the normal's bin.
uint64_t radianceCacheKey(RadianceCacheGrid g, vec3 position, vec3 normal) {
    const uint level = radianceCacheLevel(g, position);
    const vec3 inCells = (position - g.origin) / radianceCacheCellSize(g, level);
    const uvec3 cell = uvec3(ivec3(floor(clamp(inCells, -1.0e9, 1.0e9)))) & 0x1ffffu;
    return uint64_t(cell.x) | (uint64_t(cell.y) << 17) | (uint64_t(cell.z) << 34) | (uint64_t(level + 1u) << 51) |
           (uint64_t(radianceCacheNormalBin(g, normal)) << 56);
}

// The slot where the probes for a key start, modulo the capacity.
uint radianceCacheFirstSlot(uint64_t key) { return hashCombine(hash(uint(key)), uint(key >> 32)); }

// Slot of a key; NO_CELL where the table does not contain it.
uint findRadianceCell(RadianceCacheGrid g, uint64_t key) {
    const uint first = radianceCacheFirstSlot(key);
    for (uint k = 0u; k < RADIANCE_CACHE_PROBES; ++k) {
        const uint slot = (first + k) & (g.capacity - 1u);
        const uint64_t found = radianceCacheKeys.data[slot];
        if (found == key) return slot;
        if (found == 0ul) break;
    }
    return NO_CELL;
}

// Slot of a key, which is inserted where the table does not contain it; NO_CELL where all slots that are probed hold
// other keys. Slots are not emptied during a dispatch, so a key has one slot whatever the order of threads.
// `collisions`: slots with other keys that the insertion probed. With linear probing their sum over all cells does not
// depend on the order either.
uint insertRadianceCell(RadianceCacheGrid g, uint64_t key, out bool isNew, out uint collisions) {
    isNew = false;
    collisions = 0u;
    const uint first = radianceCacheFirstSlot(key);
    for (uint k = 0u; k < RADIANCE_CACHE_PROBES; ++k) {
        const uint slot = (first + k) & (g.capacity - 1u);
        uint64_t found = radianceCacheKeys.data[slot];
        if (found == 0ul) {
            found = atomicCompSwap(radianceCacheKeys.data[slot], 0ul, key);
            isNew = found == 0ul;
            if (isNew) collisions = k;
        }
        if (isNew || found == key) return slot;
    }
    return NO_CELL;
}

// Adds a sample of irradiance, W/m², not negative; clamped to 2^16 times the scene's mean irradiance.
void addRadianceSample(RadianceCacheGrid g, uint slot, vec3 irradiance) {
    const vec3 units = min(irradiance * g.unitsPerIrradiance, vec3(17592186044416.0));  // 2^44
    for (uint c = 0u; c < 3u; ++c)
        if (units[c] >= 0.5) atomicAdd(radianceCacheSums.data[4u * slot + c], uint64_t(units[c] + 0.5));
    atomicAdd(radianceCacheSums.data[4u * slot + 3u], uint64_t(RADIANCE_CACHE_SAMPLE_UNITS));
}

// Mean irradiance of a cell, W/m²; w: its number of samples.
vec4 meanRadianceCell(RadianceCacheGrid g, uint slot) {
    const float units = float(radianceCacheSums.data[4u * slot + 3u]);
    if (units == 0.0) return vec4(0.0);
    const float samples = units / float(RADIANCE_CACHE_SAMPLE_UNITS);
    const vec3 sum = vec3(float(radianceCacheSums.data[4u * slot]), float(radianceCacheSums.data[4u * slot + 1u]),
                          float(radianceCacheSums.data[4u * slot + 2u]));
    return vec4(sum / (g.unitsPerIrradiance * samples), samples);
}

#endif
