// The walk of a fragment shader: one of the raster methods.
#if defined(DOMINANT_AXIS)
#include "passes/common/triangle_walk/dominant_axis.glsl"
#elif defined(SAMPLED_AXIS)
#include "passes/common/triangle_walk/sampled_axis.glsl"
#else
#include "passes/common/triangle_walk/three_axis.glsl"
#endif
