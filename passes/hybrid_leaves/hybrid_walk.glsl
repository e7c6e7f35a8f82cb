// Rays through the leaves of a hybrid octree (Seok 2021, chapter 4; docs/hybrid-leaves.md): the closest triangle of a list, or cell of a
// grid. The including shader is compiled with VoxelMarch::defines(), which tell the walk from leaf to leaf, and given its bindings,
// those of HybridLeaves and those of the scene. Triangles that leaves hold are the second exception to the rule that passes trace
// streams alone (docs/writing-a-pass.md).
#ifndef VOXRAY_HYBRID_WALK_GLSL
#define VOXRAY_HYBRID_WALK_GLSL

#include "passes/hybrid_leaves/grid_cell.glsl"
#include "passes/hybrid_leaves/leaf_box.glsl"
#include "passes/hybrid_leaves/ray_triangle.glsl"
#include "shaders/voxel_march/voxel_march.glsl"

// Rays and triangles of lists that this thread has tested.
uint hybridTests = 0u;

// The part [begin, end] of a ray in a leaf, from the leaf's corner.
LeafSegment leafSegment(vec3 from, vec3 way, float begin, float end) {
    return LeafSegment(from + 0.5 * (begin + end) * way, 0.5 * (end - begin) * way);
}

// Tests the triangles of a list that lie where the part [begin, end] of a ray in the leaf is, also where they reach out of the leaf:
// the closest of all counts.
void meetList(VoxelGrid g, vec3 origin, vec3 direction, float tMin, float begin, float end, ivec3 voxel, uint leaf, inout Hit best) {
    const uint first = firstItem(leaf), items = LIST_ITEMS(hybridLeaves.shape.capacity);
    const bool hasGroups = leaf != first;
    LeafLists lists = hybridLeaves.primitives;  // Read once: no compiler takes it out of the loop.
    const float halfSteps = float(2 * LEAF_BOX_STEPS);
    const vec3 from = ((origin - g.origin) / g.voxelSize - vec3(voxel)) * halfSteps, way = direction / g.voxelSize * halfSteps;
    LeafSegment s = leafSegment(from, way, begin, end);
    bool isLast = false;
    for (uint i = 0u; i < items && !isLast;) {
        // Each turn finds the next triangle to test: threads whose lists differ still test together.
        uint box = 0u;
        bool isFound = false;
        while (!isFound && !isLast) {
            // An item before a group tells whether to pass over all of it.
            const bool isGroup = hasGroups && i % (LIST_GROUP + 1u) == 0u;
            box = lists.data[first + i].box;
            const bool isMet = meetsLeafBox(s, box);
            isLast = (box & LIST_ENDS) != 0u && !(isGroup && isMet);
            isFound = isMet && !isGroup;
            i += isGroup && !isMet ? LIST_GROUP + 1u : 1u;
        }
        if (!isFound) break;
        const uint triangle = lists.data[first + i - 1u].triangle;
        if (triangle != best.triangle) {
            ++hybridTests;
            meetTriangle(origin, direction, tMin, triangle, (box & LEAF_BOX_IS_MASKED) != 0u, best);
            s = leafSegment(from, way, begin, min(end, best.t));
        }
    }
}

// The closest of the cells of a leaf's grid on the part [begin, end] of a ray (Amanatides and Woo 1987; Seok 2021, figure 15). A ray
// meets a cell where it passes between the two planes that enclose the cell's surfaces, at the plane half way or as near to it as it
// comes within the cell. So a flat surface is as thin as it is, no surface is missed, and rays past an edge go on. Cells are passed
// over where they hold the surface that the ray leaves. They are of the coarsest level whose cells are not wider than the ray where
// it comes to the grid; of the finest for a narrower ray.
void meetGrid(VoxelGrid g, vec3 origin, vec3 direction, float begin, float end, ivec3 voxel, uint grid, RayStart start,
              inout Hit best) {
    // Read once: no compiler takes them out of the loop
    LargeUints bits = hybridLeaves.gridBits, ranks = hybridLeaves.gridRanks, cells = hybridLeaves.cells;
    const uint cellWords = hybridLeaves.shape.cellWords;

    const float finest = g.voxelSize / float(hybridLeaves.shape.gridResolution), ray = abs(start.width + start.spread * begin);
    const uint doublings = min(uint(log2(max(ray / finest, 1.0))), hybridLeaves.shape.gridLevels - 1u);
    const GridLevel level = gridLevel(grid, doublings);
    const int edge = int(level.edge);
    const float width = finest * float(1u << doublings);
    const vec3 from = (origin - (g.origin + vec3(voxel) * g.voxelSize)) / width, way = direction / width;
    const bvec3 isDown = lessThan(way, vec3(0.0)), isLevel = equal(way, vec3(0.0));
    const ivec3 next = mix(ivec3(1), ivec3(-1), isDown);

    // Heights above the plane of the surface that the ray leaves, up to which that plane's cells reach; walks are off by units of
    // a voxel
    const float widest = width * (1.0 + VOXEL_MARGIN) + g.voxelSize * 4.0 / float(MARCH_UNITS);
    const float rise = dot(start.normal, direction), reach = dot(abs(start.normal), vec3(1.0)) * widest;
    ivec3 cell = clamp(ivec3(floor(from + begin * way)), ivec3(0), ivec3(edge - 1));
    float enters = begin;
    for (int i = 0; i < 3 * edge && enters <= min(end, best.t); ++i) {
        const vec3 planes = vec3(cell) + mix(vec3(1.0), vec3(0.0), isDown);
        const vec3 parts = mix((planes - from) / way, vec3(1.0e30), isLevel);
        const float leaves = min(parts.x, min(parts.y, parts.z));
        ++marchSteps;
        ++marchVisits;
        const uint number = gridCellNumber(bits, ranks, gridBit(level, cell));
        const bool isOwn = start.normal != vec3(0.0) && enters * rise < reach;
        if (number != NO_CELL && !isOwn) {
            const GridCell c = gridCellAt(cells, number * cellWords);
            const float slope = dot(c.normal, way);
            const float onPlane = (c.distance_ - dot(c.normal, from - (vec3(cell) + 0.5))) / slope;
            const float t = slope == 0.0 ? enters : clamp(onPlane, enters, max(leaves, enters));
            const float height = dot(c.normal, from + t * way - (vec3(cell) + 0.5)) - c.distance_;
            // A triangle of another leaf that the ray meets within the cell is closer to the truth.
            const bool isTriangle = best.triangle < HIT_IS_CELL && best.t <= leaves;
            if (t < best.t && abs(height) <= c.reach && !isTriangle) best = Hit(t, HIT_IS_CELL | number, width, 0.0);
        }
        const int axis = parts.x <= parts.y && parts.x <= parts.z ? 0 : parts.y <= parts.z ? 1 : 2;
        cell[axis] += next[axis];
        if (cell[axis] < 0 || cell[axis] >= edge) return;
        enters = max(enters, leaves);
    }
}

// The closest surface on a ray from `origin` (m) between tMin and tMax, which may be infinite; t counts in multiples of `direction`.
// Hit::triangle tells what it is (passes/hybrid_leaves/hybrid_types.h), Hit::t is tMax where it is NO_HIT. `start`: what the ray
// leaves behind, RayStart(vec3(0.0), 0.0, 0.0) for a bare ray. Where the ray has become wider than `widest` (m) and has met nothing,
// HIT_IS_WIDE: from there on cones go on through the octree's levels (section 4: "when the cone is large").
Hit hybridClosest(VoxelGrid g, vec3 origin, vec3 direction, float tMin, float tMax, RayStart start, float widest) {
    Hit best = Hit(tMax, NO_HIT, 0.0, 0.0);
    float from = tMin, to = tMax;
    VoxelSegment s;
    if (!segmentOfRay(g, origin, direction, from, to, s)) return best;
    const float rounding = MARCH_TIE * (to - from);
    beginWalk(g, s);
    ivec3 at = firstVoxel(s);
    const uint bound = voxelsBetween(s);
    for (uint i = 0u; i <= bound; ++i) {
        if (!walkOn(g, s, at)) break;
        const ivec3 voxel = at ^ s.flip;
        const vec3 entries = mix(partsTo(s, unitsTo(s, at)), vec3(0.0), equal(s.run, vec3(0.0)));
        const float enters = from + clamp(max(entries.x, max(entries.y, entries.z)), 0.0, 1.0) * (to - from);
        if (best.t < enters - rounding) break;
        if (start.width + start.spread * enters > widest) {
            best = Hit(enters, HIT_IS_WIDE, 0.0, 0.0);
            break;
        }
        const vec3 parts = partsTo(s, unitsTo(s, at + 1));
        const float leaves = from + min(min(parts.x, min(parts.y, parts.z)), 1.0) * (to - from);
        const uint leaf = hybridLeaves.words.data[voxelNumber(g, voxel)];
        if (isGridLeaf(leaf))
            meetGrid(g, origin, direction, enters, leaves, voxel, leaf & ~LEAF_IS_GRID, start, best);
        else if (!isEmptyLeaf(leaf))
            meetList(g, origin, direction, tMin, enters - rounding, leaves + rounding, voxel, leaf, best);
        // A hit within the leaf is the closest: whatever is closer has a part in this leaf or in those before. One behind it may be
        // hidden yet.
        if (best.triangle != NO_HIT && best.t <= leaves - rounding) break;
        if (!leaveVoxel(s, at)) break;
    }
    return best;
}

#endif
