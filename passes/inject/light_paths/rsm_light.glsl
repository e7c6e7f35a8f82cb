// Texels of reflective shadow maps as light rays with known hits. Needs the bindings of shaders/scene/scene.glsl.
#ifndef VOXRAY_RSM_LIGHT_GLSL
#define VOXRAY_RSM_LIGHT_GLSL

#include "passes/inject/light_paths/light_path_types.h"
#include "shaders/lights/light_view.glsl"
#include "shaders/lights/rsm_types.h"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

// The ray through a texel's center, with the power through the texel: E * area, or I * solid angle (at its center;
// exact as texels shrink). Inactive without power.
Ray rsmRay(LightView view, GpuLight light, uint resolution, ivec2 texel, out LightPath path) {
    const vec2 onView = texelCenter(view, resolution, texel);
    const float width = texelWidth(view, resolution);
    const TexelRay beam = texelRay(view, onView);
    Ray ray = Ray(beam.origin, 0.0, normalize(beam.direction), 1.0e30);
    path = LightPath(vec3(0.0), 0.0, 0.0, 0.0);
    if (view.parallel != 0u) {
        path.area = width * width;
        path.power = light.intensity * path.area;
    } else {
        path.solidAngle = width * width * pow(1.0 + dot(onView, onView), -1.5);
        path.power = light.intensity * path.solidAngle;
        if (light.type == LIGHT_SPOT) path.power *= spotFalloff(light, dot(ray.direction, light.direction));
    }
    if (all(equal(path.power, vec3(0.0)))) ray.tMax = -1.0;
    return ray;
}

// The hit of its ray.
Hit rsmHit(RsmTexel texel, Ray ray) {
    Hit hit = Hit(0.0, texel.triangle, texel.barycentrics.x, texel.barycentrics.y);
    if (hit.triangle != NO_HIT) hit.t = distance(surfacePoint(hit.triangle, texel.barycentrics).position, ray.origin);
    return hit;
}

#endif
