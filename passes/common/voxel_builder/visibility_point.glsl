// A point on a surface whose two sides are probed.
#ifndef VOXRAY_VISIBILITY_POINT_GLSL
#define VOXRAY_VISIBILITY_POINT_GLSL

struct ProbePoint {
    vec3 position;  // In the voxel that the point counts for.
    uint triangle;
};

#endif
