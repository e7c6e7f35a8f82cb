// Tests the shadow rays of a batch against their virtual lights' maps. A receiver is occluded where its tangent plane,
// on the ray of the nearest texel, lies behind that texel's depth: flat surfaces do not shadow themselves. Half a
// texel's width is allowed for curvature and rounding.
#ifdef CUBES
#include "shaders/lights/light_view.glsl"
#else
#include "passes/vpls/gather_vpls/hemi_octahedral.glsl"
#endif
#include "passes/vpls/gather_vpls/receiver.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer ActiveVpls { uint data[]; } activeVpls;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
#if defined(CUBES)
layout(scalar) readonly buffer Views { LightView data[]; } views;  // Six of each map, in the order of cubeFace().
readonly buffer Maps { float data[]; } maps;  // By view and texel: depth over LightView::farthest.
#elif defined(SPLATTED)
// By texel: inverse depth, 1/m, in multiples of hemiOctahedralPoint(); 0: unknown.
readonly buffer Maps { float data[]; } maps;
#else
layout(scalar) readonly buffer Hits { Hit data[]; } hits;  // By texel.
#endif
writeonly buffer Occluded { uint data[]; } occluded;
layout(push_constant, scalar) uniform Push {
    VplBatch batch;
    uint resolution;  // Texels along an edge.
} push;

#ifdef CUBES
bool isUnoccluded(Vpl vpl, uint map, Receiver r) {
    const ivec2 last = ivec2(push.resolution) - 1;
    const uint index = 6u * map + cubeFace(r.position - vpl.position);
    const LightView view = views.data[index];
    const ivec2 texel = clamp(ivec2(floor(texelCoordinates(view, push.resolution, r.position))), ivec2(0), last);
    const float depth = maps.data[(index * push.resolution + uint(texel.y)) * push.resolution + uint(texel.x)];
    return texelPassesShadowTest(view, push.resolution, texel, depth, r.position, r.faceNormal);
}
#else
// The distance to the surface in a texel, m; false where there is none.
bool mapDepth(uint map, ivec2 texel, vec3 octahedronPoint, out float t) {
    const uint index = (map * push.resolution + uint(texel.y)) * push.resolution + uint(texel.x);
#ifdef SPLATTED
    t = length(octahedronPoint) / maps.data[index];
    return maps.data[index] > 0.0;
#else
    t = hits.data[index].t;
    return hits.data[index].triangle != NO_HIT;
#endif
}

bool isUnoccluded(Vpl vpl, uint map, Receiver r) {
    const ivec2 last = ivec2(push.resolution) - 1;
    const vec3 toReceiver = r.position - vpl.position;
    const ivec2 texel = clamp(ivec2(hemiOctahedralUv(toReceiver, vpl.normal) * float(push.resolution)), ivec2(0), last);
    const vec3 octahedronPoint = hemiOctahedralPoint((vec2(texel) + 0.5) / float(push.resolution), vpl.normal);
    const vec3 texelDirection = normalize(octahedronPoint);
    float t;
    if (!mapDepth(map, texel, octahedronPoint, t)) return true;
    const float cosReceiver = dot(texelDirection, r.faceNormal);
    // The mean solid angle of a texel is 2 pi / resolution²
    const float texelWidth = t * sqrt(2.0 * PI) / float(push.resolution);
    return cosReceiver < 0.0 && t + 0.5 * texelWidth >= dot(toReceiver, r.faceNormal) / cosReceiver;
}
#endif

void main() {
    const uint i = linearIndex();
    const VplBatch b = push.batch;
    if (i >= b.receiverCount * b.vplCount) return;
    const Ray ray = rays.data[i];
    const uint map = i / b.receiverCount;
    Receiver r;
    bool isOccluded = false;
    if (ray.tMax > ray.tMin && receiver(b, i % b.receiverCount, r))
        isOccluded = !isUnoccluded(vpls.data[activeVpls.data[b.firstVpl + map]], map, r);
    occluded.data[i] = isOccluded ? 1u : 0u;
}
