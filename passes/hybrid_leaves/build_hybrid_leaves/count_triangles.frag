#include "passes/common/triangle_voxelizer/raster.glsl"
#include "passes/hybrid_leaves/build_hybrid_leaves/count_triangles.glsl"
