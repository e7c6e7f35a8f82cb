#include "passes/common/triangle_voxelizer/raster.glsl"
#include "passes/common/voxel_builder/add_surfaces.glsl"
