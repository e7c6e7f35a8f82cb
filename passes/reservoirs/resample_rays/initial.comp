// Receivers of gather rays, and the reservoir of each ray's own hit.
#include "passes/reservoirs/reservoir.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/view/gather_layout.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
#ifdef TEMPORAL
uniform sampler2D previous;
#endif
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer Light { vec4 data[]; } light;
layout(scalar) readonly buffer NearDistances { float data[]; } nearDistances;
layout(scalar) writeonly buffer Receivers { Receiver data[]; } receivers;
layout(scalar) writeonly buffer Reservoirs { Reservoir data[]; } reservoirs;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
    vec3 camera;  // m
} push;

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.rays) return;
    const uint ray = push.firstBlock * g.raysPerBlock + i, blockIndex = ray / g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const ivec2 texel = ivec2(texelOf(g, block, rayTexel(g, block, ray % g.raysPerBlock)));
    const vec4 from = all(lessThan(texel, ivec2(g.texels))) ? texelFetch(position, texel, 0) : vec4(0.0);

    Receiver receiver = Receiver(vec3(0.0), 0.0, 0u, 0u, 0u);
    Reservoir own = kNoSample;
    if (from.w > 0.0) {
        const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        receiver.origin = from.xyz + faceNormal * from.w;
        receiver.distance_ = distance(from.xyz, push.camera);
        receiver.normal = toOctahedral(normalize(texelFetch(normal, texel, 0).xyz));
        receiver.faceNormal = toOctahedral(faceNormal);
#ifdef TEMPORAL
        receiver.instance = uint(texelFetch(previous, texel, 0).w);
#endif
        own.M = own.rays = 1.0;
    }

    // The ray's density is cos/π by solid angle
    const Hit hit = hits.data[i];
    own.light = light.data[i].rgb;
    if (from.w > 0.0 && hit.triangle != NO_HIT && luminance(own.light) > 0.0) {
        const SurfacePoint p = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
        const bool isFront = dot(p.geometricNormal, receiver.origin - p.position) >= 0.0;
        own.position = p.position;
        own.normal = toOctahedral(isFront ? p.geometricNormal : -p.geometricNormal);
        own.barycentrics = vec2(hit.u, hit.v);
        own.side = 2u * hit.triangle + (isFront ? 0u : 1u);
        const float near = nearDistances.data[i];
        own.nearDistance = distance(p.position, receiver.origin) < near ? -near : near;
        const float geometry = geometryTerm(receiver, own);
        own.W = geometry > 0.0 ? PI / geometry : 0.0;
    }
    receivers.data[ray] = receiver;
    reservoirs.data[ray] = own;
}
