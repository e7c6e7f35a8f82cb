// Rays and hits of streams, as trace/ray.h has them in C++.
#ifndef VOXRAY_SHARED_RAY_TYPES_H
#define VOXRAY_SHARED_RAY_TYPES_H

#include "shaders/shared/types.h"

#ifndef __cplusplus
struct Ray {
    vec3 origin;
    float tMin;
    vec3 direction;
    float tMax;  // Below tMin: the ray is inactive, a miss.
};
const Ray kNoRay = Ray(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), -1.0);

struct Hit {
    float t;
    uint triangle;  // NO_HIT: a miss.
    float u;
    float v;
};
#define NO_HIT 0xffffffffu
#endif

#endif
