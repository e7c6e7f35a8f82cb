// Fills a box of a clipmap level's voxels. A voxel is filtered bottom-up from all voxels of the source level in it, so
// that its value doesn't depend on the windows of finer levels.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_voxels.glsl"
#include "passes/cones/radiance/surface_radiance.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    float emission;
    ivec3 boxFirst;
    uvec3 boxSize;
    uint level;
    uint source;  // Level to filter from, whose window is its whole grid; 0: the surface voxels.
} push;

// Whether no surface passes through a voxel of a level. Tests a word, up to 32 voxels along x, at a time.
bool isEmpty(ivec3 voxel, uint level) {
    const ivec3 from = voxel << level;
    const ivec3 to = min((voxel + 1) << level, ivec3(push.grid.resolution));
    if (any(lessThan(from, ivec3(0)))) return true;
    const uint last = (1u << min(level, 5u)) - 1u;
    const uint bits = ((2u << last) - 1u) << (uint(from.x) & 31u);
    for (int z = from.z; z < to.z; ++z)
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; x += 32)
                if ((voxelOccupancy.words[voxelWord(push.grid, ivec3(x, y, z))] & bits) != 0u) return false;
    return true;
}

// The value of a voxel of the source level, 0 outside of the grid.
vec4 sourceValue(ivec3 voxel, uint face) {
    if (push.source > 0u) {
        const ClipmapWindow w = radianceVoxels.window[push.source];
        return inWindow(w, voxel) ? radianceValue(radianceIndex(push.source, voxel), face) : vec4(0.0);
    }
    return voxelRadiance(push.grid, voxelNumber(push.grid, voxel), face, push.emission);
}

// The `index`-th descendant of a voxel, `depth` levels below. Order: on each level the four pairs along the face's
// axis, of each pair the front voxel first.
ivec3 descendant(ivec3 voxel, uint depth, uint index, uint face) {
    const uint axis = face >> 1;
    for (uint d = depth; d-- > 0u;) {
        const uint octant = index >> (3u * d);
        ivec3 step_;
        step_[axis] = int((octant & 1u) ^ (1u - (face & 1u)));
        step_[axis == 0u ? 1u : 0u] = int((octant >> 1) & 1u);
        step_[axis == 2u ? 1u : 2u] = int((octant >> 2) & 1u);
        voxel = 2 * voxel + step_;
    }
    return voxel;
}

// Filters a voxel from the level `depth` below. The values of each level are quantized, as if it had been filtered from
// the stored level below. Partial results by level: `front`, the front voxel of a pair; `sum`, of the pairs before it.
vec4 filtered(ivec3 voxel, uint depth, uint face) {
    const bool byFace = radianceVoxels.grid.directions == 6u;
    vec4 sum[RADIANCE_CLIPMAP_LEVELS], front[RADIANCE_CLIPMAP_LEVELS];
    for (uint d = 0u; d <= depth; ++d) sum[d] = vec4(0.0);
    vec4 value = vec4(0.0);
    const uint end = 1u << (3u * depth);
    for (uint index = 0u; index < end;) {
        // The largest empty descendant at this index, else the one of the source level
        uint d = index == 0u ? depth : uint(findLSB(index)) / 3u;
        if (push.source > 0u) d = 0u;
        while (d > 0u && !isEmpty(descendant(voxel, depth - d, index >> (3u * d), face), d)) --d;
        value = d > 0u ? vec4(0.0) : sourceValue(descendant(voxel, depth, index, face), face);
        value = quantizedRadiance(value);
        const uint descendants = 1u << (3u * d);

        // Ascend while this is the last of its parent's children
        for (; d < depth; ++d) {
            const uint octant = (index >> (3u * d)) & 7u;
            if ((octant & 1u) == 0u) {
                front[d] = value;
                break;
            }
            sum[d] += byFace ? compositePair(front[d], value) : 0.5 * (front[d] + value);
            if (octant != 7u) break;
            value = quantizedRadiance(0.25 * sum[d]);
            sum[d] = vec4(0.0);
        }
        index += descendants;
    }
    return value;
}

void main() {
    const uint i = linearIndex();
    const uvec3 size = push.boxSize;
    if (i >= size.x * size.y * size.z) return;
    const ivec3 voxel = push.boxFirst + ivec3(i % size.x, i / size.x % size.y, i / (size.x * size.y));
    const RADIANCE_INDEX index = radianceIndex(push.level, voxel);
    const bool empty = push.source == 0u && isEmpty(voxel, push.level);
    for (uint face = 0u; face < radianceVoxels.grid.directions; ++face)
        storeRadiance(index, face, empty ? vec4(0.0) : filtered(voxel, push.level - push.source, face));
}
