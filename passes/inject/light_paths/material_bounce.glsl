// How a ray of light goes on from a surface by that surface's own lobes. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_MATERIAL_BOUNCE_GLSL
#define VOXRAY_MATERIAL_BOUNCE_GLSL

#include "passes/inject/light_paths/light_bounce.glsl"
#include "shaders/scene/lobe_ray.glsl"

Specular specularAt(GpuMaterial m, SurfacePoint s) {
    const vec2 rough = lookup(m.metallicRoughnessTexture, s.texCoords, 0.0).gb;
    return makeSpecular(baseColor(m, s, 0.0).rgb, m.metallic * rough.y, m.roughness * rough.x, m.specular, m.specularColor, m.ior);
}

float largest(vec3 v) { return max(v.r, max(v.g, v.b)); }

// Takes a ray on from where it hit: by the specular lobe or by the diffuse one below it, each as often as it reflects, so that the power
// of surviving rays stays level. Lobes are the same from both sides, so that light is followed as eyes' rays are. False where it ends
// there. `mirrors`: whether perfect mirrors send it on. `index`, `seed`: as of bounceLightRay().
bool bounceByMaterial(SurfacePoint s, LightVertex p, bool mirrors, uint index, uint seed, inout Ray ray, inout LightPath path) {
    const Specular specular = specularAt(sceneMaterials.data[s.material], s);
    const vec3 from = -ray.direction, n = specularNormal(p.normal, from);
    const bool hasLobe = hasSpecular(specular);
    const float weight = schlickWeight(dot(n, from));
    const float bySpecular = hasLobe ? largest(specularFresnel(specular, weight)) : 0.0;
    const float byDiffuse = largest(p.albedo) * (hasLobe ? diffuseFraction(specular, weight) : 1.0);
    const float total = bySpecular + byDiffuse, survives = min(total, 1.0), choice = sobol2(index, hashCombine(seed, 1u)).x;
    if (choice >= survives) return false;

    const vec2 u = sobol2(index, seed);
    vec3 direction;
    if (choice < survives * bySpecular / total) {
        if (isMirror(specular) && !mirrors) return false;
        const LobeRay on = lobeRay(specular, n, p.faceNormal, from, u, 1u);
        direction = on.direction;
        path.power *= on.weight * (total / (survives * bySpecular));
    } else {
        direction = cosineDirection(u, n);
        const float through = hasLobe ? diffuseFraction(specular, schlickWeight(dot(from, normalize(from + direction)))) : 1.0;
        path.power *= p.albedo * (through * total / (survives * byDiffuse));
    }
    if (dot(direction, p.faceNormal) <= 0.0 || all(equal(path.power, vec3(0.0)))) return false;
    ray = Ray(p.position + p.faceNormal * p.offset, 0.0, direction, 1.0e30);
    return true;
}

#endif
