// The first ray of each listed slot, from its g-buffer texel.
#include "passes/hybrid_leaves/gather_mirror/batch.glsl"
#include "shaders/scene/lobe_ray.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D specular;
uniform sampler2D fresnel;
readonly buffer Slots { uint data[]; } slots;
layout(scalar) buffer Paths { MirrorPath data[]; } paths;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
#ifdef HYBRID
#include "passes/hybrid_leaves/hybrid_types.h"
layout(scalar) writeonly buffer Starts { RayStart data[]; } starts;
#endif
layout(push_constant, scalar) uniform Push {
    MirrorBatch batch;
    uint count;
} push;

// How much more a reflection spreads than what arrives, from one texel to the next along an axis: twice the angle between their
// normals, negative where the surface is hollow. 0 where they lie on different surfaces.
float curvatureSpread(ivec2 texel, ivec2 step_, vec3 p, vec3 n) {
    ivec2 other = texel + step_;
    if (any(greaterThanEqual(other, textureSize(position, 0)))) other = texel - step_;
    if (any(lessThan(other, ivec2(0)))) return 0.0;
    const vec4 q = texelFetch(position, other, 0);
    const vec3 away = q.xyz - p, m = normalize(texelFetch(normal, other, 0).xyz), bend = m - n;
    const float far = length(away);
    if (q.w == 0.0 || abs(dot(away, n + m)) > 0.2 * far || dot(n, m) < 0.9) return 0.0;
    return 2.0 * (dot(bend, away) < 0.0 ? -length(bend) : length(bend));
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const MirrorBatch b = push.batch;
    const uint slot = slots.data[i];
    const ivec2 texel = texelOf(b, slot / b.rays);
    const vec4 at = texelFetch(position, texel, 0);
    const vec3 p = at.xyz;
    const Specular s = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
    const vec3 away = p - b.camera, out_ = -normalize(away);
    const vec3 shading = normalize(texelFetch(normal, texel, 0).xyz), n = specularNormal(shading, out_);
    const vec3 side = normalize(texelFetch(geometricNormal, texel, 0).xyz);

    // A ray by the lobe. Numbers of a texel are those of one sequence.
    const uint number = uint(texel.y) * b.width * b.samples + uint(texel.x), rays_ = isMirror(s) ? 1u : b.rays;
    const LobeRay ray = lobeRay(s, n, side, out_, sobol2(slot % b.rays, hashCombine(b.seed, number)), rays_);

    // Its footprint: the texel's, which grows on as before, faster by the mirror's curvature and by what the ray stands for.
    const float forward = dot(-out_, b.forward), texelSpread = sqrt(b.texelArea * forward * forward * forward);
    float spread = texelSpread;
    if (isMirror(s))
        spread += 0.5 * (curvatureSpread(texel, ivec2(1, 0), p, shading) + curvatureSpread(texel, ivec2(0, 1), p, shading));
    spread = spread < 0.0 ? spread : sqrt(spread * spread + ray.solidAngle);

    const vec3 throughput = rayWeight(b, s.roughness) / float(rays_) * ray.weight;
    const bool isLost = all(equal(throughput, vec3(0.0)));
    paths.data[i] = MirrorPath(throughput, slot, texelSpread * length(away), spread, isMirror(s) ? 1u : 0u);
    rays.data[i] = isLost ? kNoRay : Ray(p + side * at.w, 0.0, ray.direction, 1.0e30);
#ifdef HYBRID
    starts.data[i] = RayStart(side, paths.data[i].width, paths.data[i].spread);
#endif
}
