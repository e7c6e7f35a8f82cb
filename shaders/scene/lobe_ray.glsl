// Rays that a specular lobe sends out.
#ifndef VOXRAY_LOBE_RAY_GLSL
#define VOXRAY_LOBE_RAY_GLSL

#include "shaders/scene/sampling.glsl"
#include "shaders/scene/specular.glsl"

struct LobeRay {
    vec3 direction;    // Unit length.
    vec3 weight;       // Radiance reflected over radiance that arrives along the ray; 0 where it is lost below the surface.
    float solidAngle;  // Of the cone about it that stands for it among `rays` of its kind; 0 of a mirror.
};

// Towards `out_`, on a surface with shading normal `n` (not leaning away from it) and geometric normal `side`. Half vectors are
// drawn from the visible ones, so that the weight is Fresnel's term times the masking of the ray alone. What a ray stands for is one
// over the density at the lobe's peak (Křivánek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling"): in its tails
// cones would be so wide that the surface itself blocks them. The cone is half as wide, for its direction wanders through all of that,
// and the full width would blur twice.
LobeRay lobeRay(Specular s, vec3 n, vec3 side, vec3 out_, vec2 u, uint rays) {
    LobeRay ray = LobeRay(n, vec3(0.0), 0.0);
    const float cosOut = min(dot(n, out_), 1.0);
    if (isMirror(s)) {
        ray.direction = reflect(-out_, n);
        if (dot(ray.direction, side) > 0.0) ray.weight = specularFresnel(s, schlickWeight(cosOut));
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
    if (in_.z <= 0.0 || dot(ray.direction, side) <= 0.0) return ray;

    const float rootOut = smithRoot(local.z, alpha), rootIn = smithRoot(in_.z, alpha);
    ray.weight = specularFresnel(s, schlickWeight(cosHalf)) * in_.z * (local.z + rootOut) / (in_.z * rootOut + local.z * rootIn);
    const float peakDensity = 0.5 / (PI * alpha * alpha * (local.z + rootOut));
    ray.solidAngle = 0.25 / (float(rays) * peakDensity);
    return ray;
}

#endif
