// What a punctual light brings to a point without shadow.
#ifndef VOXRAY_UNSHADOWED_GLSL
#define VOXRAY_UNSHADOWED_GLSL

#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/lights/lights.glsl"

// W/m²
vec3 unshadowed(GpuLight light, PointPlace s, out vec3 direction) {
    const LightSample l = samplePunctual(light, s.position);
    direction = l.direction;
    return l.irradiance * max(dot(s.normal, l.direction), 0.0);
}

#endif
