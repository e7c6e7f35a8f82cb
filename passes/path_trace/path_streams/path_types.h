// Structs of the path tracer's streams, shared by C++ and GLSL.
#ifndef VOXRAY_PATH_TYPES_H
#define VOXRAY_PATH_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Paths that are traced together: some samples of some pixels. Pixels are numbered by tiles of PATH_TILE x PATH_TILE
// from left to right, those beyond the image's edges too.
struct PathBatch {
    uint firstPixel;
    uint pixels;
    uint firstSample;  // Of a pixel's samples.
    uint samples;      // Of each pixel.
    uint width;        // Of the image, pixels.
    uint height;
    uint halves;         // Independent sequences among a pixel's samples: 2, 1 where it has a single sample.
    uint pointsOfPixel;  // Of sequences that pixels share; 0: each has its own (pixel_points.h).
    uint seed;
};

// A path where a ray leaves, in the order of the rays. Its `slot` is its number in the batch.
struct PathVertex {
    vec3 throughput;
    float bsdfPdf;              // Of the ray's direction, 1/sr; DELTA_PDF where light sampling can't find what it hits.
    vec3 irradianceThroughput;  // Throughput without the first hit's BSDF.
    uint slot;
    vec3 faceNormal;  // Where the ray leaves, on its side; lights are picked by it.
};

// Light that arrives along a ray if nothing occludes it.
struct LightAlongRay {
    vec3 light;  // Without the path's throughput, W/(m² sr).
    uint slot;
    vec3 throughput;
    vec3 irradianceThroughput;
};

// What a path has brought so far, by slot.
struct PathSums {
    vec3 direct;      // Emission and direct light at the first hit, W/(m² sr).
    float distance_;  // From the first to the second hit, m; 1e30 without one.
    vec3 indirect;
    uint hasIrradiance;  // Whether the first hit reflects diffusely.
    vec3 irradiance;     // Of indirect light at the first hit, W/m².
};

// Sums over a pixel's samples, by half, and by how much rounding has made each too large.
struct PixelSums {
    vec3 total[2];
    vec3 indirect[2];
    vec3 excessTotal[2];
    vec3 excessIndirect[2];
};

// An emissive triangle, or two that form a parallelogram of constant emission.
struct LightPatch {
    uint triangle;
    uint isParallelogram;
    float inverseArea;  // 1/m²
    uint leaf;          // Of the light tree; NO_LEAF where samples miss its light.
};

// What shaders need to know of all lights.
struct PathLights {
    uint treeNodes;               // 0: no light in the tree.
    uint punctualLights;          // Numbers of the tree below are theirs, others those of patches.
    uint infiniteLights;          // Beside the tree.
    float treeIntensity;          // Importance times this is W/m² of luminance.
    float environmentIrradiance;  // As a choice weighs it, W/m² of luminance.
    uint isSingle;                // 1: there is one light to draw.
    uint canBeHit;                // 1: paths can hit emissive surfaces or the environment.
};

VOXRAY_SHARED_END

#define PATH_TILE 4u
#define DELTA_PDF -1.0f
#define NO_LEAF 0xffffffffu
// Among infinite lights.
#define ENVIRONMENT_LIGHT 0xffffffffu
// Of a triangle: its patch, NO_PATCH without one; and whether its material and vertices are constants: it is flat,
// without textures and vertex colors.
#define PATCH_BITS 0x7fffffffu
#define NO_PATCH PATCH_BITS
#define IS_SIMPLE 0x80000000u

// Streams that a batch counts for each vertex.
#define STREAM_RAYS 0u         // To the vertex.
#define STREAM_SHADOW_RAYS 1u  // From the vertex.
#define STREAM_HIT_LIGHTS 2u   // Light that rays to the vertex hit, behind panes.
#define STREAMS 3u

#endif
