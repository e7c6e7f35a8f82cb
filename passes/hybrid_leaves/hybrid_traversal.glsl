// Traversal of a hybrid octree's leaves (Seok 2021, chapter 4; docs/hybrid-leaves.md): the closest triangle of a list
// or cell of a grid. The including shader is compiled with VoxelMarch::defines(), which select the traversal from leaf
// to leaf, and gets the bindings of VoxelMarch, HybridLeaves and the scene. Triangles in leaves are the second
// exception to the rule that passes trace whole streams (docs/writing-a-pass.md).
#ifndef VOXRAY_HYBRID_TRAVERSAL_GLSL
#define VOXRAY_HYBRID_TRAVERSAL_GLSL

#include "passes/hybrid_leaves/grid_cell.glsl"
#include "passes/hybrid_leaves/leaf_box.glsl"
#include "passes/hybrid_leaves/ray_triangle.glsl"
#include "shaders/voxel_march/voxel_march.glsl"

// Ray-triangle tests of this invocation.
uint hybridTests = 0u;

// The segment [tBegin, tEnd] of a ray, in coordinates of the leaf.
LeafSegment leafSegment(vec3 origin, vec3 direction, float tBegin, float tEnd) {
    return LeafSegment(origin + 0.5 * (tBegin + tEnd) * direction, 0.5 * (tEnd - tBegin) * direction);
}

// Intersects a ray with the triangles of a leaf's list whose boxes its segment [tBegin, tEnd] in the leaf hits. Hits
// beyond the leaf count as well: `closest` is the closest of all.
void intersectList(VoxelGrid g, vec3 origin, vec3 direction, float tMin, float tBegin, float tEnd, ivec3 voxel,
                   uint leaf, inout Hit closest) {
    const uint first = firstItem(leaf), items = LIST_ITEMS(hybridLeaves.shape.capacity);
    const bool hasGroups = leaf != first;
    LeafLists lists = hybridLeaves.primitives;  // Loop-invariant load, which compilers do not hoist.
    const float halfStepsPerEdge = float(2 * LEAF_BOX_STEPS);
    const vec3 originInLeaf = ((origin - g.origin) / g.voxelSize - vec3(voxel)) * halfStepsPerEdge;
    const vec3 directionInLeaf = direction / g.voxelSize * halfStepsPerEdge;
    LeafSegment segment = leafSegment(originInLeaf, directionInLeaf, tBegin, tEnd);
    bool isLast = false;
    for (uint item = 0u; item < items && !isLast;) {
        // Find the next triangle to test: invocations with different lists then test at the same time.
        uint box = 0u;
        bool isFound = false;
        while (!isFound && !isLast) {
            // A group's item: skip the whole group on a miss
            const bool isGroup = hasGroups && item % (LIST_GROUP + 1u) == 0u;
            box = lists.data[first + item].box;
            const bool isHit = intersectsLeafBox(segment, box);
            isLast = (box & LIST_ENDS) != 0u && !(isGroup && isHit);
            isFound = isHit && !isGroup;
            item += isGroup && !isHit ? LIST_GROUP + 1u : 1u;
        }
        if (!isFound) break;
        const uint triangle = lists.data[first + item - 1u].triangle;
        if (triangle != closest.triangle) {
            ++hybridTests;
            intersectTriangle(origin, direction, tMin, triangle, (box & LEAF_BOX_IS_MASKED) != 0u, closest);
            segment = leafSegment(originInLeaf, directionInLeaf, tBegin, min(tEnd, closest.t));
        }
    }
}

// The closest cell of a leaf's grid on the segment [tBegin, tEnd] of a ray (Amanatides and Woo 1987; Seok 2021, figure
// 15). A ray hits a cell where it passes through the slab that encloses the cell's surfaces: at the slab's middle
// plane, or as close to it as the ray comes within the cell. So flat surfaces are hit at their own depth, none is
// missed, and rays past an edge continue. Cells of the surface that the ray starts from are skipped. The grid's level
// is the coarsest whose cells are not wider than the ray at the grid; the finest for narrower rays.
void intersectGrid(VoxelGrid g, vec3 origin, vec3 direction, float tBegin, float tEnd, ivec3 voxel, uint grid,
                   RayStart start, inout Hit closest) {
    // Loop-invariant loads, which compilers do not hoist
    LargeUints bits = hybridLeaves.gridBits, ranks = hybridLeaves.gridRanks, cells = hybridLeaves.cells;
    const uint cellWords = hybridLeaves.shape.cellWords;

    const float finest = g.voxelSize / float(hybridLeaves.shape.gridResolution),
                rayWidth = abs(start.width + start.spread * tBegin);
    const uint levelIndex = min(uint(log2(max(rayWidth / finest, 1.0))), hybridLeaves.shape.gridLevels - 1u);
    const GridLevel level = gridLevel(grid, levelIndex);
    const int edge = int(level.edge);
    const float cellWidth = finest * float(1u << levelIndex);
    const vec3 originInGrid = (origin - (g.origin + vec3(voxel) * g.voxelSize)) / cellWidth;
    const vec3 directionInGrid = direction / cellWidth;
    const bvec3 isNegative = lessThan(directionInGrid, vec3(0.0)), isParallel = equal(directionInGrid, vec3(0.0));
    const ivec3 step_ = mix(ivec3(1), ivec3(-1), isNegative);

    // Up to this height above the plane of the start surface, cells may contain it; marching is off by units of a voxel
    const float startCellWidth = cellWidth * (1.0 + VOXEL_MARGIN) + g.voxelSize * 4.0 / float(MARCH_UNITS);
    const float heightPerT = dot(start.normal, direction),
                startHeight = dot(abs(start.normal), vec3(1.0)) * startCellWidth;
    ivec3 cell = clamp(ivec3(floor(originInGrid + tBegin * directionInGrid)), ivec3(0), ivec3(edge - 1));
    float tEntry = tBegin;
    for (int i = 0; i < 3 * edge && tEntry <= min(tEnd, closest.t); ++i) {
        const vec3 planes = vec3(cell) + mix(vec3(1.0), vec3(0.0), isNegative);
        const vec3 tPlanes = mix((planes - originInGrid) / directionInGrid, vec3(1.0e30), isParallel);
        const float tExit = min(tPlanes.x, min(tPlanes.y, tPlanes.z));
        ++marchSteps;
        ++marchVisits;
        const uint cellIndex = gridCellIndex(bits, ranks, gridBit(level, cell));
        const bool isStartCell = start.normal != vec3(0.0) && tEntry * heightPerT < startHeight;
        if (cellIndex != NO_CELL && !isStartCell) {
            const GridCell c = gridCellAt(cells, cellIndex * cellWords);
            const float slope = dot(c.normal, directionInGrid);
            const float tPlane = (c.distance_ - dot(c.normal, originInGrid - (vec3(cell) + 0.5))) / slope;
            const float t = slope == 0.0 ? tEntry : clamp(tPlane, tEntry, max(tExit, tEntry));
            const float height = dot(c.normal, originInGrid + t * directionInGrid - (vec3(cell) + 0.5)) - c.distance_;
            // A triangle of another leaf that the ray hits within the cell is more accurate
            const bool isTriangle = closest.triangle < HIT_IS_CELL && closest.t <= tExit;
            if (t < closest.t && abs(height) <= c.halfThickness && !isTriangle)
                closest = Hit(t, HIT_IS_CELL | cellIndex, cellWidth, 0.0);
        }
        const int axis = tPlanes.x <= tPlanes.y && tPlanes.x <= tPlanes.z ? 0 : tPlanes.y <= tPlanes.z ? 1 : 2;
        cell[axis] += step_[axis];
        if (cell[axis] < 0 || cell[axis] >= edge) return;
        tEntry = max(tEntry, tExit);
    }
}

// The closest surface on a ray from `origin` (m) between tMin and tMax, which may be infinite; t is in units of
// `direction`. Hit::triangle encodes what was hit (passes/hybrid_leaves/hybrid_types.h); where it is NO_HIT, Hit::t is
// tMax. `start`: RayStart(vec3(0.0), 0.0, 0.0) for a ray without surface and width. HIT_IS_WIDE where the ray is wider
// than `maxWidth` (m) before any hit: a cone continues from there (section 4: "when the cone is large").
Hit hybridClosestHit(VoxelGrid g, vec3 origin, vec3 direction, float tMin, float tMax, RayStart start, float maxWidth) {
    Hit closest = Hit(tMax, NO_HIT, 0.0, 0.0);
    float tFirst = tMin, tLast = tMax;
    VoxelSegment s;
    if (!segmentOfRay(g, origin, direction, tFirst, tLast, s)) return closest;
    const float rounding = MARCH_TIE * (tLast - tFirst);
    initTraversal(g, s);
    ivec3 flippedVoxel = firstVoxel(s);
    const uint bound = voxelsBetween(s);
    for (uint i = 0u; i <= bound; ++i) {
        if (!advanceToOccupied(g, s, flippedVoxel)) break;
        const ivec3 voxel = flippedVoxel ^ s.flip;
        const vec3 entries =
            mix(planeParameters(s, unitsToPlanes(s, flippedVoxel)), vec3(0.0), equal(s.run, vec3(0.0)));
        const float tEntry = tFirst + clamp(max(entries.x, max(entries.y, entries.z)), 0.0, 1.0) * (tLast - tFirst);
        if (closest.t < tEntry - rounding) break;
        if (start.width + start.spread * tEntry > maxWidth) {
            closest = Hit(tEntry, HIT_IS_WIDE, 0.0, 0.0);
            break;
        }
        const vec3 exits = planeParameters(s, unitsToPlanes(s, flippedVoxel + 1));
        const float tExit = tFirst + min(min(exits.x, min(exits.y, exits.z)), 1.0) * (tLast - tFirst);
        const uint leaf = hybridLeaves.words.data[voxelNumber(g, voxel)];
        if (isGridLeaf(leaf))
            intersectGrid(g, origin, direction, tEntry, tExit, voxel, leaf & ~LEAF_IS_GRID, start, closest);
        else if (!isEmptyLeaf(leaf))
            intersectList(g, origin, direction, tMin, tEntry - rounding, tExit + rounding, voxel, leaf, closest);
        // A hit within the leaf is the closest: a closer surface would be in this leaf or an earlier one. A hit beyond
        // may be behind others
        if (closest.triangle != NO_HIT && closest.t <= tExit - rounding) break;
        if (!leaveVoxel(s, flippedVoxel)) break;
    }
    return closest;
}

#endif
