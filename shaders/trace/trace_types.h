// What the GPU ray tracers' shaders read, shared by C++ (trace/gpu_tracer.cpp) and GLSL (shaders/trace/).
#ifndef VOXRAY_TRACE_TYPES_H
#define VOXRAY_TRACE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// One launch over a part of a stream. Buffers are given by address: a stream may be larger than a device
// binds.
struct TraceCall {
    uint64_t rays;             // Ray each.
    uint64_t results;          // Hit each (closest hit), or uint each (occluded).
    uint64_t chunkFirst;       // uint each instance: the first of its triangles in tracing order.
    uint64_t triangleIds;      // uint each triangle in tracing order: its number in the scene.
    uint64_t corners;          // 3 uints each triangle in tracing order: its vertices.
    uint64_t positions;        // 3 floats each vertex.
    uint64_t maskedTriangles;  // MaskedTriangle each; they come last in tracing order.
    uint64_t alphaMaterials;   // AlphaMaterial each.
    uint64_t alphaTexels;      // 8-bit alphas, four to a uint.
    uint firstRay;
    uint endRay;
    uint opaqueCount;  // Triangles before the masked ones.
    uint padding;
};

// What decides whether a hit on an alpha-masked triangle counts.
struct MaskedTriangle {
    vec2 uv[3];      // The base-colour texture's coordinates at the vertices, transformed.
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
#define MAX_COORDINATE 1.8e18  // As Embree has it: a ray beyond it is a miss.

#endif
