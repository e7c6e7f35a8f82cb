// Hits on the edges of triangles. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_INSET_BARYCENTRICS_GLSL
#define VOXRAY_INSET_BARYCENTRICS_GLSL

#include "shaders/scene/scene.glsl"

// Moves a point of a triangle away from its edges by the rounding error of interpolation, four roundings. On the edge
// between a floor and a wall rounding would decide on which side of the wall the point is: behind it the point is dark,
// and mirror rays leave the room.
vec2 insetBarycentrics(uint triangle, vec2 barycentrics) {
    const uvec3 v = triangleVertices(triangle);
    const vec3 a = vertexPosition(v.x), b = vertexPosition(v.y), c = vertexPosition(v.z);
    const float error = 4.8e-7 * largestCoordinate(max(abs(a), max(abs(b), abs(c))));
    const float size = sqrt(max(length(cross(b - a, c - a)), 1.0e-37));
    const vec3 w = max(vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics), min(error / size, 0.25));
    return w.yz / (w.x + w.y + w.z);
}

#endif
