// A point on a surface whose two sides are tested for visibility.
#ifndef VOXRAY_PROBE_POINT_GLSL
#define VOXRAY_PROBE_POINT_GLSL

struct ProbePoint {
    vec3 position;
    uint triangle;
};

#endif
