// Where a ray that leaves a surface may start.
#ifndef VOXRAY_SURFACE_OFFSET_GLSL
#define VOXRAY_SURFACE_OFFSET_GLSL

#extension GL_EXT_scalar_block_layout : require

layout(scalar) readonly buffer SceneSize { float diagonal; } sceneSize;  // Of its bounds, m.

// So far off the surface, m: an error bound of float positions. A point of a large triangle is as uncertain as the triangle's corners
// are, so the scene's size counts besides the point's own coordinates: wherever a scene lies near the origin, it is the same offset.
float surfaceOffset(vec3 position) {
    const vec3 a = abs(position);
    return 4e-6 * max(sceneSize.diagonal, max(a.x, max(a.y, a.z)));
}

#endif
