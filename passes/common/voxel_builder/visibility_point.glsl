// A point on a surface whose two sides are probed.
#ifndef VOXRAY_VISIBILITY_POINT_GLSL
#define VOXRAY_VISIBILITY_POINT_GLSL

#extension GL_EXT_scalar_block_layout : require

struct ProbePoint {
    vec3 position;  // In the voxel that the point counts for.
    uint triangle;
};

#endif
