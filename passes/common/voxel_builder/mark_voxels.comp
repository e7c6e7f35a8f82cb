#include "passes/common/triangle_walk/exact.glsl"
#include "passes/common/voxel_builder/mark_voxels.glsl"
