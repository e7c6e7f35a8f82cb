// Radiance voxels in a sparse octree: the functions that shaders/radiance_voxels.glsl promises.
#ifndef VOXRAY_RADIANCE_SVO_GLSL
#define VOXRAY_RADIANCE_SVO_GLSL

#include "shaders/octree.glsl"
#include "shaders/radiance_texel.glsl"

// What the node sends against a direction: the three faces that look against it, by squared component.
vec4 octreeRadiance(uint node, vec3 direction) {
    if (radianceOctree.shape.directions == 1u) return unpackRadiance(radianceOctree.values.data[node]);
    vec4 sum = vec4(0.0);
    for (uint axis = 0u; axis < 3u; ++axis) {
        const uint face = 2u * axis + (direction[axis] > 0.0 ? 1u : 0u);
        const uint at = face * radianceOctree.shape.nodeCount + node;
        sum += direction[axis] * direction[axis] * unpackRadiance(radianceOctree.values.data[at]);
    }
    return sum;
}

// The first of the two cells along each axis between whose middles a point lies, and how far it is from there to the second.
ivec3 cellsRound(vec3 position, uint level, out vec3 between) {
    const vec3 at = (position - radianceOctree.shape.origin) / (radianceOctree.shape.voxelSize * float(1u << level)) - 0.5;
    between = fract(at);
    return ivec3(floor(at));
}

// Weight of one of the eight cells round a point in trilinear interpolation.
float cellWeight(ivec3 corner, vec3 between) {
    const vec3 w = mix(1.0 - between, between, vec3(corner));
    return w.x * w.y * w.z;
}

// The level that a footprint falls on, with its fraction.
float octreeLevel(float footprint) {
    return clamp(log2(footprint / radianceOctree.shape.voxelSize), 0.0, float(radianceOctree.shape.levels));
}

vec4 sampleRadiance(vec3 position, float footprint, vec3 direction) {
    const float levelOf = octreeLevel(footprint);
    const uint fine = min(uint(levelOf), radianceOctree.shape.levels - 1u);
    const float coarseShare = levelOf - float(fine);

    // The eight nodes round the point on the coarser level.
    vec3 between;
    const ivec3 coarseCell = cellsRound(position, fine + 1u, between);
    uvec4 nodes[2];
    vec4 coarse = vec4(0.0);
    bool empty = true;
    for (int i = 0; i < 8; ++i) {
        const ivec3 corner = ivec3(i, i >> 1, i >> 2) & 1;
        const uint node = octreeNode(coarseCell + corner, fine + 1u);
        nodes[i >> 2][i & 3] = node;
        if (node == NO_NODE) continue;
        empty = false;
        if (coarseShare > 0.0) coarse += cellWeight(corner, between) * octreeRadiance(node, direction);
    }
    if (empty || coarseShare == 1.0) return coarseShare * coarse;

    // The eight nodes of the finer level are children of those.
    const ivec3 fineCell = cellsRound(position, fine, between);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        const ivec3 corner = ivec3(i, i >> 1, i >> 2) & 1;
        const ivec3 cell = fineCell + corner;
        const ivec3 parent = (cell >> 1) - coarseCell;
        const uint coarseNode = nodes[parent.z][parent.x + 2 * parent.y];
        if (coarseNode == NO_NODE) continue;
        const uint node = octreeChild(coarseNode, octantOf(uvec3(cell)));
        if (node != NO_NODE) sum += cellWeight(corner, between) * octreeRadiance(node, direction);
    }
    return mix(sum, coarse, coarseShare);
}

float emptyDistance(vec3 position, float footprint, vec3 direction) {
    // A sample reads the eight cells round it on two levels: those of the coarser one enclose the others.
    const uint finest = min(uint(octreeLevel(footprint)) + 1u, radianceOctree.shape.levels);
    vec3 between;
    const ivec3 cell = cellsRound(position, finest, between);

    // The largest cube that holds none of them.
    float distance_ = 0.0;
    const float side = radianceOctree.shape.voxelSize * float(1u << finest);
    for (uint level = finest + 1u; level <= radianceOctree.shape.levels; ++level) {
        const ivec3 low = cell >> (level - finest);
        if (any(notEqual(low, (cell + 1) >> (level - finest)))) continue;
        if (octreeNode(low, level) != NO_NODE) break;
        // The point may move until one of the cells leaves the cube: as far as half a cell from its faces.
        const vec3 first = radianceOctree.shape.origin + side * (vec3(low << (level - finest)) + 0.5);
        const vec3 last = radianceOctree.shape.origin + side * (vec3((low + 1) << (level - finest)) - 0.5);
        const vec3 towards = mix(first, last, greaterThan(direction, vec3(0.0))) - position;
        const vec3 reach = mix(towards / direction, vec3(1.0e30), equal(direction, vec3(0.0)));
        distance_ = max(min(reach.x, min(reach.y, reach.z)), 0.0);
    }
    return distance_;
}

float finestFootprint(vec3 position) { return radianceOctree.shape.voxelSize; }

#endif
