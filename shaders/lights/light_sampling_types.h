// Limits of light sampling, shared by C++ and GLSL (shaders/lights/lights.glsl).
#ifndef VOXRAY_SHARED_LIGHT_SAMPLING_TYPES_H
#define VOXRAY_SHARED_LIGHT_SAMPLING_TYPES_H

#define MAX_LIGHT_CANDIDATES 32u  // For a sample.

#endif
