// Writes the surfaces that the camera rays of a batch of pixels hit to the G-buffer's images. Where all rays of a pixel
// hit one surface, they share the material and the normals at the pixel's center, with textures filtered over the pixel,
// as with multisampling; each has its own point. Other pixels are listed for store_surfaces.comp.
#include "passes/view/gbuffer/sample_direction.glsl"
#include "passes/view/gbuffer/sampled_texel.glsl"
#include "passes/view/gbuffer/stored_texel.glsl"
#include "shaders/compute/indirect_list.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/inset_barycentrics.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(push_constant, scalar) uniform Push {
    CameraView view;
    uint firstRay;
    uint batchRays;
} push;

struct Triangle {
    vec3 a, b, c;
    vec3 normal;  // Unit; 0 of a degenerate triangle.
};

Triangle triangleOf(uint index) {
    const uvec3 v = triangleVertices(index);
    Triangle t = Triangle(vertexPosition(v.x), vertexPosition(v.y), vertexPosition(v.z), vec3(0.0));
    const vec3 n = cross(t.b - t.a, t.c - t.a);
    if (dot(n, n) > 0.0) t.normal = normalize(n);
    return t;
}

// Normals of one surface differ by 8 degrees at most; the segment between two of its points is off the plane of either
// by half of that, as on a circle.
#define LEAST_COSINE 0.990268
#define MOST_OFF_PLANE 0.0697565

bool isOneSurface(vec3 normalA, vec3 a, vec3 normalB, vec3 b) {
    const float off = max(abs(dot(normalA, b - a)), abs(dot(normalB, b - a)));
    return dot(normalA, normalB) > LEAST_COSINE && off <= MOST_OFF_PLANE * distance(a, b);
}

// Barycentrics of the point where a ray from the camera meets a triangle's plane (Möller and Trumbore 1997), a bit
// outside of the triangle at most. @param otherwise for a ray along the plane.
vec2 planeBarycentrics(Triangle t, vec3 direction, vec2 otherwise) {
    const vec3 toB = t.b - t.a, toC = t.c - t.a, fromA = push.view.origin - t.a, p = cross(direction, toC);
    const float determinant = dot(toB, p);
    if (determinant == 0.0) return otherwise;
    return clamp(vec2(dot(fromA, p), dot(direction, cross(fromA, toB))) / determinant, -1.0, 2.0);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays / TEXELS) return;
    const uint pixel = push.firstRay / TEXELS + i;
    const Hit first = hits.data[i * TEXELS];
    const bool isHit = first.triangle != NO_HIT;
    const uint material = isHit ? triangleMaterial(first.triangle) : 0u;
    bool isOne = isHit && sceneMaterials.data[material].alphaMode != ALPHA_MASK;

    // Store points, and find out whether they are of one surface
    Triangle firstTriangle;
    vec3 firstPoint;
    for (uint t = 0u; t < TEXELS; ++t) {
        const Hit hit = hits.data[i * TEXELS + t];
        isOne = isOne && hit.triangle != NO_HIT;
        if (!isOne) break;
        const Triangle triangle = triangleOf(hit.triangle);
        const vec2 at = insetBarycentrics(hit.triangle, vec2(hit.u, hit.v));
        const vec3 point = interpolate(vec3(1.0 - at.x - at.y, at), triangle.a, triangle.b, triangle.c);
        if (t == 0u) {
            firstTriangle = triangle;
            firstPoint = point;
        }
        isOne = triangleMaterial(hit.triangle) == material &&
                isOneSurface(firstTriangle.normal, firstPoint, triangle.normal, point);
        const float offset = max(planeOffset(triangle.a, triangle.b, triangle.c, triangle.normal), pointOffset(point));
        storePoint(texelOf(pixel, t, push.view.width), vec4(point, offset), previousPoint(hit.triangle, at));
    }
    if (!isOne) {
        appendItem(i, TEXELS);
        return;
    }

    CameraView pixels = push.view;
    pixels.width /= SAMPLES;
    pixels.height /= SAMPLES;
    const vec3 direction = viewDirection(pixels, uvec2(texelOf(pixel, 0u, push.view.width) / SAMPLES));
    const vec2 center = planeBarycentrics(firstTriangle, direction, vec2(first.u, first.v));
    const SurfacePoint s = surfacePoint(first.triangle, insetBarycentrics(first.triangle, center));
    const VisibleSurface visible = visibleSurface(pixels, s);
    for (uint t = 0u; t < TEXELS; ++t) storeSurface(texelOf(pixel, t, push.view.width), visible, true, true);
}
