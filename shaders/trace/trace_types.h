// Alpha masks for the GPU ray tracers, shared by C++ (trace/gpu_tracer.cpp) and GLSL (shaders/trace/).
#ifndef VOXRAY_TRACE_TYPES_H
#define VOXRAY_TRACE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct MaskedTriangle {
    vec2 uv[3];      // Transformed coordinates of the base-colour texture, by vertex.
    float alpha[3];  // Vertex alpha times the material's factor.
    uint material;   // Index into the alpha materials.
};

struct AlphaMaterial {
    float threshold;  // Alphas below it are cut away.
    uint firstTexel;  // NO_ALPHA_TEXTURE: alpha 1 everywhere.
    uint width;
    uint height;
    uint wrapU;  // WRAP_*
    uint wrapV;
    uint filter_;  // FILTER_*
};

VOXRAY_SHARED_END

#define NO_ALPHA_TEXTURE 0xffffffffu

#endif
