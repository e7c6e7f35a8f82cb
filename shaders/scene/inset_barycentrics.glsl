// Points that are seen on the edges of triangles. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_OFF_EDGES_GLSL
#define VOXRAY_OFF_EDGES_GLSL

#include "shaders/scene/scene.glsl"

// A point of a triangle, moved off its edges by the four roundings that interpolation takes: on the edge between a floor and a wall
// they would decide which side of the wall it lies on, and from outside no light comes to it and a mirror's ray gets lost.
vec2 insetBarycentrics(uint triangle, vec2 barycentrics) {
    const uvec3 v = triangleVertices(triangle);
    const vec3 a = vertexPosition(v.x), b = vertexPosition(v.y), c = vertexPosition(v.z);
    const float uncertain = 4.8e-7 * largestCoordinate(max(abs(a), max(abs(b), abs(c))));
    const float size = sqrt(max(length(cross(b - a, c - a)), 1.0e-37));
    const vec3 w = max(vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics), min(uncertain / size, 0.25));
    return w.yz / (w.x + w.y + w.z);
}

#endif
