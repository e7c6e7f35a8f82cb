// Sampling of specular lobes.
#ifndef VOXRAY_LOBE_RAY_GLSL
#define VOXRAY_LOBE_RAY_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/scene/specular.glsl"

struct LobeRay {
    vec3 direction;    // Unit length.
    // BRDF times cosine over the density: reflected over incident radiance; 0 for a ray below the surface.
    vec3 weight;
    float solidAngle;  // Of the ray's footprint, sr; 0 for a mirror.
};

// One of `rays` samples of the lobe towards `out_`, on a surface with shading normal `n` (facing out_) and geometric
// normal `ng`, by visible half vectors: the weight is Fresnel's term times the masking of the incident direction. The
// footprint is 1 / (rays * density) with the density at the lobe's peak (Křivánek and Colbert 2008, "Real-time Shading
// with Filtered Importance Sampling"): in the tails cones would be so wide that the surface itself occludes them. A
// quarter of it, half the width, is taken: samples are distributed over the lobe, and the full width would blur twice.
LobeRay lobeRay(Specular s, vec3 n, vec3 ng, vec3 out_, vec2 u, uint rays) {
    LobeRay ray = LobeRay(n, vec3(0.0), 0.0);
    const float cosOut = min(dot(n, out_), 1.0);
    if (isMirror(s)) {
        ray.direction = reflect(-out_, n);
        if (dot(ray.direction, ng) > 0.0) ray.weight = specularFresnel(s, schlickWeight(cosOut));
        return ray;
    }
    const float alpha = specularAlpha(s);
    vec3 tangent, bitangent;
    frame(n, tangent, bitangent);
    const vec3 local = vec3(dot(out_, tangent), dot(out_, bitangent), max(cosOut, 1e-5));
    const vec3 half_ = visibleNormal(local, alpha, u);
    const float cosHalf = dot(local, half_);
    const vec3 in_ = 2.0 * cosHalf * half_ - local;
    ray.direction = normalize(in_.x * tangent + in_.y * bitangent + in_.z * n);
    if (in_.z <= 0.0 || dot(ray.direction, ng) <= 0.0) return ray;

    const float rootOut = smithRoot(local.z, alpha), rootIn = smithRoot(in_.z, alpha);
    ray.weight =
        specularFresnel(s, schlickWeight(cosHalf)) * in_.z * (local.z + rootOut) / (in_.z * rootOut + local.z * rootIn);
    const float peakDensity = 0.5 / (PI * alpha * alpha * (local.z + rootOut));
    ray.solidAngle = 0.25 / (float(rays) * peakDensity);
    return ray;
}

#endif
