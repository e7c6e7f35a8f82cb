#version 460
#extension GL_GOOGLE_include_directive : require
// Starts a batch of rays from one source of light; each carries the source's power over the number of its rays.
#include "shaders/compute/linear_index.glsl"
#include "shaders/lights/lights.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/light_paths/light_path_types.h"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Paths { LightPath data[]; } paths;
layout(push_constant, scalar) uniform Push {
    uint kind;
    uint light;
    uint firstRay;
    uint batchRays;
    uint totalRays;
    uint seed;
    uint emitterCount;
    vec3 sceneCenter;
    float sceneRadius;
} push;

// A point on the disc that the scene fits behind, seen along a direction.
vec3 discPoint(vec2 u, vec3 direction) {
    vec3 t, b;
    frame(direction, t, b);
    const float r = push.sceneRadius * sqrt(u.x), phi = 2.0 * PI * u.y;
    return push.sceneCenter - direction * push.sceneRadius + t * (r * cos(phi)) + b * (r * sin(phi));
}

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uint index = push.firstRay + i;
    const vec2 u = sobol2(index, hashCombine(push.seed, 0u));
    const vec2 u2 = sobol2(index, hashCombine(push.seed, 1u));
    Ray ray;
    ray.tMin = 0.0;
    ray.tMax = 1.0e30;
    LightPath path = LightPath(vec3(0.0), 0.0, 0.0, 0.0);

    if (push.kind == SOURCE_PUNCTUAL) {
        const GpuLight light = sceneLights.data[push.light];
        ray.origin = light.position;
        if (light.type == LIGHT_POINT) {
            // Uniform over the sphere: flux = I * 4 pi.
            ray.direction = sphereDirection(u);
            path.solidAngle = 4.0 * PI;
            path.power = light.intensity * path.solidAngle;
        } else if (light.type == LIGHT_SPOT) {
            // Uniform over the outer cone: flux = I(angle) * its solid angle.
            ray.direction = coneDirection(u, light.direction, light.cosOuter);
            path.solidAngle = 2.0 * PI * (1.0 - light.cosOuter);
            path.power = light.intensity * spotFalloff(light, dot(ray.direction, light.direction)) * path.solidAngle;
        } else {
            // Uniform over the disc: flux = E * its area.
            ray.direction = light.direction;
            ray.origin = discPoint(u, light.direction);
            path.area = PI * push.sceneRadius * push.sceneRadius;
            path.power = light.intensity * path.area;
        }
    } else if (push.kind == SOURCE_EMITTERS) {
        // A triangle by its power, a point uniform on it, a direction by cosine: flux = L * pi * area / probability.
        const float pick = sobol2(index, hashCombine(push.seed, 2u)).x;
        const GpuEmitter emitter = sceneEmitters.data[pickEmitter(push.emitterCount, pick)];
        const SurfacePoint s = surfacePoint(emitter.triangle, trianglePoint(u2));
        const GpuMaterial m = sceneMaterials.data[s.material];
        const float sides = m.doubleSided != 0u ? 2.0 : 1.0;
        const bool back = m.doubleSided != 0u && (hash(hashCombine(push.seed, index)) & 1u) != 0u;
        const vec3 n = back ? -s.geometricNormal : s.geometricNormal;
        ray.origin = s.position + n * surfaceOffset(s.position);
        ray.direction = cosineDirection(u, n);
        path.power = emission(m, s, 0.0) * PI * emitter.area * sides / emitter.probability;
    } else {
        // Uniform over directions and over the disc: flux = L * 4 pi * its area.
        ray.direction = -sphereDirection(u);
        ray.origin = discPoint(u2, ray.direction);
        path.power = environmentRadiance(-ray.direction) * 4.0 * PI * PI * push.sceneRadius * push.sceneRadius;
    }
    if (all(equal(path.power, vec3(0.0)))) ray.tMax = -1.0;
    rays.data[i] = ray;

    // Each of the rays is an equal part of all that the source sends.
    path.power /= float(push.totalRays);
    path.solidAngle /= float(push.totalRays);
    path.area /= float(push.totalRays);
    paths.data[i] = path;
}
