// Samples where their surfaces are in this frame, and where they were in the previous one.
#ifndef VOXRAY_RESERVOIR_MOVED_SAMPLE_GLSL
#define VOXRAY_RESERVOIR_MOVED_SAMPLE_GLSL

#include "passes/reservoirs/reservoir.glsl"
#include "shaders/scene/scene.glsl"

layout(scalar) readonly buffer PreviousPositionsRef { VertexPositions previousPositions; };

// Whether the sample's surface has moved since the previous frame. Vertices are compared, which are copies: places that
// two programs interpolate may differ by rounding.
bool hasMoved(Reservoir y) {
    const uvec3 v = triangleVertices(y.side / 2u);
    return vertexPosition(v.x) != previousPositions.data[v.x] || vertexPosition(v.y) != previousPositions.data[v.y] ||
           vertexPosition(v.z) != previousPositions.data[v.z];
}

Reservoir placedOn(Reservoir y, vec3 p0, vec3 p1, vec3 p2) {
    y.position = interpolate(vec3(1.0 - y.barycentrics.x - y.barycentrics.y, y.barycentrics), p0, p1, p2);
    const vec3 front = normalize(cross(p1 - p0, p2 - p0));
    y.normal = toOctahedral(y.side % 2u == 0u ? front : -front);
    return y;
}

// A sample of the previous frame in this one.
Reservoir sampleNow(Reservoir y) {
    const uvec3 v = triangleVertices(y.side / 2u);
    return placedOn(y, vertexPosition(v.x), vertexPosition(v.y), vertexPosition(v.z));
}

// A sample of this frame in the previous one.
Reservoir sampleBefore(Reservoir y) {
    const uvec3 v = triangleVertices(y.side / 2u);
    return placedOn(y, previousPositions.data[v.x], previousPositions.data[v.y], previousPositions.data[v.z]);
}

#endif
