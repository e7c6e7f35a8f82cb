// Where a ray that leaves a surface may start.
#ifndef VOXRAY_SURFACE_OFFSET_GLSL
#define VOXRAY_SURFACE_OFFSET_GLSL

#extension GL_EXT_scalar_block_layout : require

layout(scalar) readonly buffer SceneExtent { float largest; } sceneExtent;  // Of all coordinates' absolutes, m.

// So far off the surface, m: an error bound of float positions. A point of a large triangle that passes near the
// origin is as uncertain as the triangle's vertices are, so the scene's extent counts besides the point's own
// coordinates.
float surfaceOffset(vec3 position) {
    const vec3 a = abs(position);
    return 4e-6 * max(a.x, max(a.y, a.z)) + 5e-7 * sceneExtent.largest;
}

#endif
