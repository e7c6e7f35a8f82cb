// Materials of surface groups (VoxelPatches::materials).
#ifndef VOXRAY_GROUP_MATERIALS_GLSL
#define VOXRAY_GROUP_MATERIALS_GLSL

#include "passes/clusters/surface_group_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer GroupMaterials { PackedGroupMaterial data[]; };
layout(scalar) readonly buffer GroupMaterialsRef { GroupMaterials groupMaterials; };

VoxelMaterial groupMaterial(uint group) { return unpackGroupMaterial(groupMaterials.data[group]); }

#endif
