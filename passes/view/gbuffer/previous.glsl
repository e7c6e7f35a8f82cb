// Positions of surface points in the previous frame.
#ifndef VOXRAY_GBUFFER_PREVIOUS_GLSL
#define VOXRAY_GBUFFER_PREVIOUS_GLSL

#include "shaders/scene/scene.glsl"

layout(scalar) readonly buffer PreviousPositionsRef { VertexPositions previousPositions; };
layout(scalar) readonly buffer InstanceStarts { uint data[]; } instanceStarts;  // First triangle of each mesh instance.

vec3 previousPosition(uint triangle, vec2 barycentrics) {
    const uvec3 v = triangleVertices(triangle);
    const vec3 p0 = previousPositions.data[v.x], p1 = previousPositions.data[v.y], p2 = previousPositions.data[v.z];
    const vec3 w = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    return interpolate(w, p0, p1, p2);
}

// Index of a triangle's mesh instance, plus 1.
float instanceOf(uint triangle) {
    uint low = 0u, high = uint(instanceStarts.data.length());
    while (low < high) {
        const uint split = (low + high) / 2u;
        if (instanceStarts.data[split] <= triangle)
            low = split + 1u;
        else
            high = split;
    }
    return float(low);
}

#endif
