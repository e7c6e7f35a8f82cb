// Shared by the GPU ray tracers: push constants, hits, alpha masks.
#ifndef VOXRAY_TRACE_GLSL
#define VOXRAY_TRACE_GLSL

#include "shaders/scene/texel_filter.glsl"
#include "shaders/trace/ray_streams.glsl"
#include "shaders/trace/trace_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Words { uint data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Corners { uvec3 data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Positions { vec3 data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer MaskedTriangles { MaskedTriangle data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer AlphaMaterials { AlphaMaterial data[]; };

// One launch over a range of a stream. Buffers are given by address. Masked triangles come last in tracing order.
layout(push_constant, scalar) uniform Push {
    uint64_t rays;             // Ray each.
    uint64_t results;          // Hit each (closest hit), or uint each (occluded).
    uint64_t chunkFirst;       // uint per instance: index of its first triangle in tracing order.
    uint64_t triangleIds;      // uint per triangle in tracing order: its index in the scene.
    uint64_t corners;          // 3 uints per triangle in tracing order: its vertices.
    uint64_t positions;        // 3 floats per vertex.
    uint64_t maskedTriangles;  // MaskedTriangle each.
    uint64_t alphaMaterials;   // AlphaMaterial each.
    uint64_t alphaTexels;      // 8-bit alphas, four per uint.
    uint64_t counted;          // uint: the number of rays; 0: endRay.
    uint firstRay;
    uint endRay;
    uint opaqueCount;  // Triangles before the masked ones.
} call;

// Index after the last ray.
uint streamEnd() { return call.counted == 0ul ? call.endRay : Words(call.counted).data[0]; }

// Index in tracing order of an instance's triangle.
uint tracingIndex(uint instance, uint primitive) {
    return Words(call.chunkFirst).data[instance] + primitive;
}

// The hit that a backend found, with its distance recomputed from the triangle's plane relative to the ray's origin:
// backends compute it from world-space coordinates, which cancels digits of short distances.
Hit makeHit(vec3 origin, vec3 direction, float t, uint instance, uint primitive, vec2 barycentrics) {
    const uint index = tracingIndex(instance, primitive);
    const uvec3 corner = Corners(call.corners).data[index];
    const vec3 a = Positions(call.positions).data[corner.x];
    const vec3 normal =
        cross(Positions(call.positions).data[corner.y] - a, Positions(call.positions).data[corner.z] - a);
    const float exact = dot(normal, a - origin) / dot(normal, direction);
    const bool isUsable = abs(exact - t) <= 1e-3 * t + 1e-5 * length(a);
    return Hit(isUsable ? exact : t, Words(call.triangleIds).data[index], barycentrics.x, barycentrics.y);
}

float alphaTexel(AlphaMaterial material, int x, int y) {
    const uint i = material.firstTexel + uint(y) * material.width + uint(x);
    const uint word = Words(call.alphaTexels).data[i >> 2];
    return float((word >> (8u * (i & 3u))) & 255u) * (1.0 / 255.0);
}

float alphaLookup(AlphaMaterial material, vec2 uv) {
    if (material.firstTexel == NO_ALPHA_TEXTURE) return 1.0;
    const Texels x = filteredTexels(uv.x, int(material.width), material.wrapU, material.filter_);
    const Texels y = filteredTexels(uv.y, int(material.height), material.wrapV, material.filter_);
    const float top = mix(alphaTexel(material, x.first, y.first), alphaTexel(material, x.second, y.first), x.weight);
    const float bottom =
        mix(alphaTexel(material, x.first, y.second), alphaTexel(material, x.second, y.second), x.weight);
    return mix(top, bottom, y.weight);
}

// Whether the alpha mask removes a hit on a masked triangle.
bool isCutAway(uint instance, uint primitive, vec2 barycentrics) {
    const uint index = tracingIndex(instance, primitive) - call.opaqueCount;
    const MaskedTriangle triangle = MaskedTriangles(call.maskedTriangles).data[index];
    const AlphaMaterial material = AlphaMaterials(call.alphaMaterials).data[triangle.material];
    const vec3 w = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    const float alpha = triangle.alpha[0] * w.x + triangle.alpha[1] * w.y + triangle.alpha[2] * w.z;
    const vec2 uv = triangle.uv[0] * w.x + triangle.uv[1] * w.y + triangle.uv[2] * w.z;
    return alpha * alphaLookup(material, uv) < material.threshold;
}

#endif
