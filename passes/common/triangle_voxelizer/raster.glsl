// The raster method that a fragment shader is compiled for.
#if defined(DOMINANT_AXIS)
#include "passes/common/triangle_voxelizer/dominant_axis.glsl"
#elif defined(SAMPLED_AXIS)
#include "passes/common/triangle_voxelizer/sampled_axis.glsl"
#else
#include "passes/common/triangle_voxelizer/three_axis.glsl"
#endif
