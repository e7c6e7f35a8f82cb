// Shared by gather_mirror's shaders and host code.
#ifndef VOXRAY_MIRROR_TYPES_H
#define VOXRAY_MIRROR_TYPES_H

#include "shaders/shared/types.h"

// Entries of schlickTable(): by the square root of the viewer's cosine, evenly spaced from 0 to 1.
#define SCHLICK_TABLE_SIZE 64

// Where the first ray of a path ended.
#define ENDS_ON_TRIANGLE 1u
#define ENDS_ON_CELL 2u
#define ENDS_AS_CONE 3u
#define ENDS_NOWHERE 4u

VOXRAY_SHARED_BEGIN

// A batch of pixels with `rays` paths per texel, some of which are active. Paths are indexed by pixel, then
// by texel.
struct MirrorBatch {
    vec3 camera;   // World position, m.
    uint width;    // Of the image, pixels.
    vec3 forward;  // Unit view direction of the camera.
    uint firstPixel;
    uint pixels;
    uint samples;          // Texels along an edge of a pixel.
    uint rays;             // Paths per texel; a perfect mirror has one.
    float maxRoughness;    // Up to it specular light is by rays only;
    float blendRoughness;  // over this range above it the weight of rays decreases to 0.
    float texelArea;       // Of a texel at unit distance in front of the camera.
    uint seed;
};

// An active path, with the footprint of its current ray (a ray cone).
struct MirrorPath {
    vec3 throughput;
    uint index;           // Among all paths of the batch.
    float width;          // Of the footprint at the ray's origin, m: the root of its area across the ray.
    float spread;         // Growth of the width per metre.
    uint countsEmission;  // 1: adds emission at hits; 0: another pass does.
};

// Radiance of a path, W/(m² sr), split into direct and indirect light as the reference does.
struct MirrorLight {
    vec3 direct;    // Emission and environment after one reflection.
    vec3 indirect;  // All other light.
    uint end;       // Of the first ray: ENDS_ON_TRIANGLE and so on; 0 for an inactive path.
};

VOXRAY_SHARED_END

#endif
