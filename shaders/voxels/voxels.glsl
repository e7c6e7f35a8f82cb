// Access to surface voxels: an occupancy bit for each voxel of the grid and, where it is set, the voxel's number
// among the occupied ones (its rank), which indexes all per-voxel data. Empty space costs two bits a voxel, nothing else.
#ifndef VOXRAY_VOXELS_GLSL
#define VOXRAY_VOXELS_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "shaders/voxels/voxel_packing.h"

#define NO_VOXEL 0xffffffffu

layout(scalar) readonly buffer VoxelOccupancy { uint words[]; } voxelOccupancy;
layout(scalar) readonly buffer VoxelRank { uint before[]; } voxelRank;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer VoxelMaterials { PackedVoxelMaterial data[]; };
layout(scalar) readonly buffer VoxelMaterialsRef { VoxelMaterials voxelMaterials; };

VoxelMaterial voxelMaterial(uint voxel) { return unpackMaterial(voxelMaterials.data[voxel]); }

// Areas and flux are sampled: below this part of a voxel's face their ratio is noise, and surfaces around it are taken, too.
#define SMALL_FACE_AREA 0.05
// Below this part nothing is known: what few rays brought to a sliver's tip would count for all that looks the same way.
#define MIN_FACE_AREA 0.001

// Area of a voxel's surfaces that open space lies in front of, at a face +x -x +y -y +z -z, in units of a voxel's face.
float unoccluded(VoxelMaterial m, uint face) {
    return (face & 1u) == 0u ? m.unoccludedPositive[face >> 1] : m.unoccludedNegative[face >> 1];
}

// Voxels that are held along each axis.
uvec3 heldVoxels(VoxelGrid g) { return min(g.resolution, uvec3(g.windowSize)); }

bool insideGrid(VoxelGrid g, ivec3 voxel) {
    return all(greaterThanEqual(voxel, g.first)) && all(lessThan(voxel, g.first + ivec3(heldVoxels(g))));
}

// The word and the bit in it of a voxel that is held.
uint voxelWord(VoxelGrid g, ivec3 voxel) {
    const uvec3 slot = uvec3(voxel) & (g.windowSize - 1u);
    return (slot.z * heldVoxels(g).y + slot.y) * g.wordsPerRow + (slot.x >> 5);
}

// The voxel that is held in a slot.
uvec3 voxelInSlot(VoxelGrid g, uvec3 slot) { return uvec3(g.first) + ((slot - uvec3(g.first)) & (g.windowSize - 1u)); }

uint voxelBit(VoxelGrid g, ivec3 voxel) { return 1u << (uint(voxel.x) & (g.windowSize - 1u) & 31u); }

bool isOccupied(VoxelGrid g, ivec3 voxel) {
    return insideGrid(g, voxel) && (voxelOccupancy.words[voxelWord(g, voxel)] & voxelBit(g, voxel)) != 0u;
}

// Number of an occupied voxel, or NO_VOXEL.
uint voxelNumber(VoxelGrid g, ivec3 voxel) {
    if (!insideGrid(g, voxel)) return NO_VOXEL;
    const uint word = voxelWord(g, voxel);
    const uint bits = voxelOccupancy.words[word];
    const uint bit = voxelBit(g, voxel);
    if ((bits & bit) == 0u) return NO_VOXEL;
    return voxelRank.before[word] + uint(bitCount(bits & (bit - 1u)));
}

ivec3 voxelAt(VoxelGrid g, vec3 position) { return ivec3(floor((position - g.origin) / g.voxelSize)); }

// The voxel that a surface point belongs to. Where rasterisation left it empty (the surface fell between its samples),
// the nearest of the voxels around it, so that no light is lost where there is a voxel next door; else NO_VOXEL.
uint nearestVoxel(VoxelGrid g, vec3 position) {
    const ivec3 cell = voxelAt(g, position);
    const uint own = voxelNumber(g, cell);
    if (own != NO_VOXEL) return own;
    const vec3 inGrid = (position - g.origin) / g.voxelSize;
    uint nearest = NO_VOXEL;
    float best = 1.0e30;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const ivec3 neighbour = cell + ivec3(x, y, z);
                const vec3 away = vec3(neighbour) + 0.5 - inGrid;
                if (dot(away, away) >= best) continue;
                const uint voxel = voxelNumber(g, neighbour);
                if (voxel == NO_VOXEL) continue;
                nearest = voxel;
                best = dot(away, away);
            }
    return nearest;
}

#endif
