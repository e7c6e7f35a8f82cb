// The walk of a fragment shader: one of the two raster methods.
#ifdef DOMINANT_AXIS
#include "passes/common/triangle_walk/dominant_axis.glsl"
#else
#include "passes/common/triangle_walk/three_axis.glsl"
#endif
