// What the GPU ray tracers share: the stream's rays, the numbers of triangles, the alpha mask.
#ifndef VOXRAY_TRACE_GLSL
#define VOXRAY_TRACE_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "shaders/trace/ray_types.h"
#include "shaders/trace/trace_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RayStream { Ray data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer HitStream { Hit data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer WordStream { uint data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Words { uint data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Corners { uvec3 data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Positions { vec3 data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer MaskedTriangles {
    MaskedTriangle data[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer AlphaMaterials {
    AlphaMaterial data[];
};

layout(push_constant, scalar) uniform Push { TraceCall call; };

// Whether a ray is active and finite; other rays miss.
bool isTraceable(Ray ray) {
    const bool finite = all(lessThanEqual(abs(ray.origin), vec3(MAX_COORDINATE))) &&
                        all(lessThanEqual(abs(ray.direction), vec3(MAX_COORDINATE)));
    return finite && any(notEqual(ray.direction, vec3(0.0))) && ray.tMin >= 0.0 && ray.tMax >= ray.tMin;
}

// Place in tracing order of an instance's triangle.
uint tracingIndex(uint instance, uint primitive) {
    return Words(call.chunkFirst).data[instance] + primitive;
}

// The hit that a backend found, with its distance taken again from the triangle's plane: backends measure from the
// scene's origin, which loses a hit's digits close to the ray's origin.
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

// The same steps as the CPU's lookup (trace/texture_lookup.cpp), so that both cut away the same points.
float reduceCoordinate(float x, uint wrap) {
    if (!(abs(x) <= 3.4e38)) return 0.0;
    if (wrap == WRAP_REPEAT) return x - floor(x);
    if (wrap == WRAP_MIRROR) return x - 2.0 * floor(0.5 * x);
    return clamp(x, 0.0, 1.0);
}

int wrapTexel(int x, int size, uint wrap) {
    if (wrap == WRAP_REPEAT) return x < 0 ? x + size : (x >= size ? x - size : x);
    if (wrap == WRAP_CLAMP) return clamp(x, 0, size - 1);
    const int r = x < 0 ? x + 2 * size : (x >= 2 * size ? x - 2 * size : x);
    return r < size ? r : 2 * size - 1 - r;
}

float alphaTexel(AlphaMaterial material, int x, int y) {
    const uint i = material.firstTexel + uint(y) * material.width + uint(x);
    const uint word = Words(call.alphaTexels).data[i >> 2];
    return float((word >> (8u * (i & 3u))) & 255u) * (1.0 / 255.0);
}

float alphaLookup(AlphaMaterial material, vec2 uv) {
    if (material.firstTexel == NO_ALPHA_TEXTURE) return 1.0;
    const ivec2 size = ivec2(material.width, material.height);
    const vec2 reduced = vec2(reduceCoordinate(uv.x, material.wrapU), reduceCoordinate(uv.y, material.wrapV));
    const vec2 p = reduced * vec2(size) - 0.5;
    const ivec2 corner = ivec2(floor(p));
    const vec2 f = p - floor(p);
    const int x0 = wrapTexel(corner.x, size.x, material.wrapU);
    const int x1 = wrapTexel(corner.x + 1, size.x, material.wrapU);
    const int y0 = wrapTexel(corner.y, size.y, material.wrapV);
    const int y1 = wrapTexel(corner.y + 1, size.y, material.wrapV);
    const float top = alphaTexel(material, x0, y0) * (1.0 - f.x) + alphaTexel(material, x1, y0) * f.x;
    const float bottom = alphaTexel(material, x0, y1) * (1.0 - f.x) + alphaTexel(material, x1, y1) * f.x;
    return top * (1.0 - f.y) + bottom * f.y;
}

// Whether a hit on a masked triangle is cut away: base colour's alpha is below the cutoff.
bool isCutAway(uint instance, uint primitive, vec2 barycentrics) {
    const uint index = tracingIndex(instance, primitive) - call.opaqueCount;
    const MaskedTriangle triangle = MaskedTriangles(call.maskedTriangles).data[index];
    const AlphaMaterial material = AlphaMaterials(call.alphaMaterials).data[triangle.material];
    const vec3 w = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    const float alpha = triangle.alpha[0] * w.x + triangle.alpha[1] * w.y + triangle.alpha[2] * w.z;
    const vec2 uv = triangle.uv[0] * w.x + triangle.uv[1] * w.y + triangle.uv[2] * w.z;
    return alpha * alphaLookup(material, uv) < material.cutoff;
}

#endif
