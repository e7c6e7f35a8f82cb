// The surfels of voxels, sorted by surface group (passes/clusters/voxel_patches.h).
#ifndef VOXRAY_GROUPED_SURFELS_GLSL
#define VOXRAY_GROUPED_SURFELS_GLSL

#include "passes/clusters/surface_group_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer GroupedSurfels { GroupedSurfel data[]; };
layout(scalar) readonly buffer GroupedSurfelsRef { GroupedSurfels groupedSurfels; };

// The point in front of a surfel at which visibility rays to other surfels begin and end, m.
vec3 pointAbove(GroupedSurfel s) { return s.position + s.height * s.normal; }

#endif
