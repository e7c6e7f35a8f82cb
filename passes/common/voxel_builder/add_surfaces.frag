#include "passes/common/triangle_walk/raster.glsl"
#include "passes/common/voxel_builder/add_surfaces.glsl"
