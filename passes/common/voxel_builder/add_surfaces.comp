#include "passes/common/triangle_voxelizer/exact.glsl"
#include "passes/common/voxel_builder/add_surfaces.glsl"
