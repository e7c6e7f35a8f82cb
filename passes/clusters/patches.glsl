// The surfels of voxels, by the side that they are on (passes/clusters/voxel_patches.h).
#ifndef VOXRAY_PATCHES_GLSL
#define VOXRAY_PATCHES_GLSL


#include "passes/clusters/patch_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchSurfels { PatchSurfel data[]; };
layout(scalar) readonly buffer PatchSurfelsAt { PatchSurfels patchSurfels; };

// A place in the space before a surfel.
vec3 raisedOver(PatchSurfel s) { return s.position + s.height * s.normal; }

#endif
