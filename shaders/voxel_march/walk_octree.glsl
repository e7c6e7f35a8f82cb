// Through the octree by the masks of two levels, without a way down from the root: two words of the table tell the empty cubes of
// four sizes. A word is 0 where there is no node, and its mask tells which of the cubes half as wide are empty. Only below the
// table's level there is a way down, with one more word a level; at 256 voxels and dense surfaces there is none.
#include "shaders/octree/octree.glsl"

// The two levels of the table, the finest and one that is two coarser where there is one, and where their words stand: read once.
struct OctreeLevel {
    int level;
    uint first;    // Of the voxel at the origin.
    uvec2 stride;  // Words from one voxel to the next, along y and z.
} fineLevel, coarseLevel;
OctreeWords tableWords, nodeWords;

OctreeLevel tableLevelOf(int level) {
    const uvec3 size = uvec3(octreeSize(uint(level)) + 2);
    return OctreeLevel(level, octreeTableEntry(ivec3(0), uint(level)), uvec2(size.x, size.x * size.y));
}

void beginWalk(VoxelGrid g) {
    const int fine = int(octree.shape.tableLevel);
    fineLevel = tableLevelOf(fine);
    coarseLevel = tableLevelOf(min(fine + 2, int(octree.shape.levels)));
    tableWords = octree.table;
    nodeWords = octree.nodes;
}

uint tableWord(OctreeLevel l, ivec3 voxel) {
    const uvec3 at = uvec3(voxel >> l.level);
    return tableWords.data[l.first + at.x + at.y * l.stride.x + at.z * l.stride.y];
}

bool hasChild(uint word, uint octant) { return (word >> octant & 1u) != 0u; }

int emptyCube(ivec3 voxel) {
    const uint coarse = tableWord(coarseLevel, voxel);
    uint word = tableWord(fineLevel, voxel);
    marchVisits += 2u;
    int level = coarse == 0u ? coarseLevel.level
                : !hasChild(coarse, octantOf(voxel >> (coarseLevel.level - 1))) ? coarseLevel.level - 1 : fineLevel.level;
    // Down from the table.
    if (word != 0u)
        for (--level; level > 0; --level) {
            if (!hasChild(word, octantOf(voxel >> level))) break;
            word = nodeWords.data[octreeChild(word, octantOf(voxel >> level))];
            ++marchVisits;
        }
    return word != 0u && level == 0 && hasChild(word, octantOf(voxel)) ? -1 : (1 << level) - 1;
}

#include "shaders/voxel_march/walk_cubes.glsl"
