#include "passes/common/triangle_walk/exact.glsl"
#include "passes/common/voxel_builder/add_surfaces.glsl"
