// Arrays of the bins of all probes, which may exceed maxStorageBufferRange (large_buffer.glsl).
#ifndef VOXRAY_PROBE_BINS_GLSL
#define VOXRAY_PROBE_BINS_GLSL

#include "shaders/compute/large_buffer.glsl"

// Irradiance, W/m²; 1 over the distance of the nearest hit, 1/m.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer ProbeBins { vec4 data[]; };

#endif
