// Surface groups of voxels, shared by C++ (passes/clusters/voxel_patches.h) and GLSL.
#ifndef VOXRAY_SHARED_SURFACE_GROUP_TYPES_H
#define VOXRAY_SHARED_SURFACE_GROUP_TYPES_H

#include "shaders/voxels/voxel_packing.h"

VOXRAY_SHARED_BEGIN

#define NO_GROUP 0xffffffffu
#define NO_COMPONENT 0xffffffffu

// Bits of SurfaceGroup::flags.
#define GROUP_FACES 0x3fu  // One for each face +x -x +y -y +z -z at which the group has a patch.
#define GROUP_OCCLUDED \
    0x40u  // It lies in a gap narrower than a voxel. It sends and receives light, but the voxel's
           // irradiance does not include it.

// The surfels of a voxel with an unobstructed line between points half a voxel above them, e.g. those on one face of a
// thin wall. It has a patch at each of the voxel's six faces at which it has area (area times the squared component of
// the normal). Its surfels and patches end where those of the
// next group begin; one more element follows the last group.
struct SurfaceGroup {
    uint voxel;
    uint firstSurfel;
    uint firstPatch;  // Index of its first patch; the others follow in the order of faces.
    uint flags;
};

// Normal, reflectance and unoccluded area of a surface group: the words of PackedVoxelMaterial that have these.
#define GROUP_MATERIAL_WORDS 6u
struct PackedGroupMaterial {
    uint words[GROUP_MATERIAL_WORDS];
};

VOXRAY_SHARED_FUNCTION PackedGroupMaterial packGroupMaterial(VoxelMaterial m) {
    const PackedVoxelMaterial all = packMaterial(m);
    PackedGroupMaterial p;
    for (uint i = 0u; i < GROUP_MATERIAL_WORDS; ++i) p.words[i] = all.words[i];
    return p;
}

// Other members than normal, reflectance and unoccluded area are 0.
VOXRAY_SHARED_FUNCTION VoxelMaterial unpackGroupMaterial(PackedGroupMaterial p) {
    PackedVoxelMaterial all;
    for (uint i = 0u; i < MATERIAL_WORDS; ++i) all.words[i] = i < GROUP_MATERIAL_WORDS ? p.words[i] : 0u;
    return unpackMaterial(all);
}

// The connected surface groups of a cluster. It has a face where one of its groups has a patch. Its members and faces
// end where those of the next component begin; one more element follows the last component.
struct ClusterComponent {
    uint firstMember;
    uint firstFace;  // Index of its first face among those of all components; the others follow in their order.
    uint faces;      // A bit for each, as GROUP_FACES.
};

VOXRAY_SHARED_END

#endif
