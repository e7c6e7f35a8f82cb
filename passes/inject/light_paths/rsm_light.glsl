// Texels of reflective shadow maps as rays from a light, whose hits are known. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_RSM_LIGHT_GLSL
#define VOXRAY_RSM_LIGHT_GLSL

#include "passes/inject/light_paths/light_path_types.h"
#include "shaders/lights/light_view.glsl"
#include "shaders/lights/rsm_types.h"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

// The ray through a texel's center, and the light through the texel: E * area, or I * solid angle (of the texel's center; exact as
// texels shrink). A ray that carries nothing is one that is not traced (tMax < tMin).
Ray rsmRay(LightView view, GpuLight light, uint resolution, ivec2 texel, out LightPath path) {
    const vec2 onView = texelCenter(view, resolution, texel);
    const float side = texelWidth(view, resolution);
    const TexelRay beam = texelRay(view, onView);
    Ray ray = Ray(beam.origin, 0.0, normalize(beam.direction), 1.0e30);
    path = LightPath(vec3(0.0), 0.0, 0.0, 0.0);
    if (view.parallel != 0u) {
        path.area = side * side;
        path.power = light.intensity * path.area;
    } else {
        path.solidAngle = side * side * pow(1.0 + dot(onView, onView), -1.5);
        path.power = light.intensity * path.solidAngle;
        if (light.type == LIGHT_SPOT) path.power *= spotFalloff(light, dot(ray.direction, light.direction));
    }
    if (all(equal(path.power, vec3(0.0)))) ray.tMax = -1.0;
    return ray;
}

// What the ray hit.
Hit rsmHit(RsmTexel seen, Ray ray) {
    Hit hit = Hit(0.0, seen.triangle, seen.barycentrics.x, seen.barycentrics.y);
    if (hit.triangle != NO_HIT) hit.t = distance(surfacePoint(hit.triangle, seen.barycentrics).position, ray.origin);
    return hit;
}

#endif
