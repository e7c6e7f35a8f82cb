// How light paths scatter by the specular and diffuse lobes of surfaces. Needs the bindings of
// shaders/scene/scene.glsl.
#ifndef VOXRAY_MATERIAL_BOUNCE_GLSL
#define VOXRAY_MATERIAL_BOUNCE_GLSL

#include "passes/inject/light_paths/light_bounce.glsl"
#include "shaders/scene/lobe_ray.glsl"

Specular specularAt(GpuMaterial m, SurfacePoint s) {
    const vec2 rough = lookup(m.metallicRoughnessTexture, s.texCoords, 0.0).gb;
    return makeSpecular(baseColor(m, s, 0.0).rgb, m.metallic * rough.y, m.roughness * rough.x, m.specular,
                        m.specularColor, m.ior);
}

float largest(vec3 v) { return max(v.r, max(v.g, v.b)); }

// Scatters a ray at its vertex by one of the lobes, sampled in proportion to its reflectance, with Russian roulette by
// the sum. Lobes are symmetric in both directions, as the reference has them; cosines are those of adjointFactor().
// False where the path ends. `mirrors`: whether perfect mirrors reflect it. `index`, `seed`: as of bounceLightRay().
bool bounceByMaterial(SurfacePoint s, LightVertex v, bool mirrors, uint index, uint seed, inout Ray ray,
                      inout LightPath path) {
    const Specular specular = specularAt(sceneMaterials.data[s.material], s);
    const float factor = adjointFactor(v, ray.direction);
    if (factor == 0.0) return false;
    const vec3 in_ = -ray.direction, n = v.normal;
    const bool hasLobe = hasSpecular(specular);
    const float weight = schlickWeight(dot(n, in_));
    const float bySpecular = hasLobe ? largest(specularFresnel(specular, weight)) : 0.0;
    const float byDiffuse = largest(v.albedo) * (hasLobe ? diffuseFraction(specular, weight) : 1.0);
    const float total = bySpecular + byDiffuse, survival = min(total, 1.0);
    const float choice = sobol2(index, hashCombine(seed, 1u)).x;
    if (choice >= survival) return false;

    const vec2 u = sobol2(index, seed);
    vec3 direction;
    if (choice < survival * bySpecular / total) {
        if (isMirror(specular) && !mirrors) return false;
        const LobeRay lobe = lobeRay(specular, n, v.faceNormal, in_, u, 1u);
        direction = lobe.direction;
        // The weight holds the shading cosine of the direction
        const float cosRatio = dot(v.faceNormal, direction) / max(dot(n, direction), 1e-5);
        path.power *= lobe.weight * (factor * cosRatio * total / (survival * bySpecular));
    } else {
        direction = cosineDirection(u, v.faceNormal);
        const vec3 half_ = normalize(in_ + direction);
        const float diffuse = hasLobe ? diffuseFraction(specular, schlickWeight(dot(in_, half_))) : 1.0;
        path.power *= v.albedo * (factor * diffuse * total / (survival * byDiffuse));
    }
    if (dot(direction, v.faceNormal) <= 0.0 || all(equal(path.power, vec3(0.0)))) return false;
    ray = Ray(v.position + v.faceNormal * v.offset, 0.0, direction, 1.0e30);
    return true;
}

#endif
