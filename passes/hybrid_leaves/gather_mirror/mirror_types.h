// What gather_mirror's shaders and its host code agree on.
#ifndef VOXRAY_MIRROR_TYPES_H
#define VOXRAY_MIRROR_TYPES_H

#include "shaders/shared/types.h"

// Values of the table of what a dielectric layer takes from diffuse light: by roots of the cosine to the
// viewer, evenly spaced from 0 to 1.
#define GRAZING_COSINES 64

// What a ray from the camera's mirror ended on.
#define ENDS_ON_TRIANGLE 1u
#define ENDS_ON_CELL 2u
#define ENDS_AS_CONE 3u
#define ENDS_NOWHERE 4u

VOXRAY_SHARED_BEGIN

// A batch of pixels. Its slots for rays: those of its pixels one after another, of a pixel those of its
// texels.
struct MirrorBatch {
    vec3 camera;   // World position, m.
    uint width;    // Pixels of a row.
    vec3 forward;  // Unit direction that the camera looks in.
    uint firstPixel;
    uint pixels;
    uint samples;          // Texels along each side of a pixel.
    uint rays;             // Slots of a texel. A mirror uses one.
    float maxRoughness;    // Up to here rays alone bring specular light,
    float blendRoughness;  // over so much more their weight falls to 0.
    float texelArea;       // Of a texel at unit distance in front of the camera.
    uint seed;
};

// A ray on its way from surface to surface.
struct MirrorPath {
    vec3 throughput;  // Radiance that reaches the camera's texel over what the ray brings.
    uint slot;
    float width;     // m, of its footprint where it starts; squared it is an area across the ray.
    float spread;    // Growth of the width for each metre.
    uint seesLamps;  // 1: what it meets of emitted light counts; 0: another pass brings that.
};

// What the rays of a slot bring, W/(m² sr), as the reference splits it.
struct MirrorLight {
    vec3 direct;    // Emission and environment by one reflection.
    vec3 indirect;  // All else.
    uint end;       // Of the first ray: ENDS_ON_TRIANGLE and so on; 0 where none went out.
};

VOXRAY_SHARED_END

#endif
