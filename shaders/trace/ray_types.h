// Rays and hits of the stream interface, as trace/ray.h has them in C++.
#ifndef VOXRAY_SHARED_RAY_TYPES_H
#define VOXRAY_SHARED_RAY_TYPES_H

#include "shaders/shared/types.h"

#ifndef __cplusplus
struct Ray {
    vec3 origin;
    float tMin;
    vec3 direction;
    float tMax;  // Below tMin: inactive, a miss.
};
const Ray kNoRay = Ray(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), -1.0);

struct Hit {
    float t;
    uint triangle;  // NO_HIT: the ray met nothing.
    float u;
    float v;
};
#define NO_HIT 0xffffffffu
#endif

#endif
