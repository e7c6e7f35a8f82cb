#version 460
#extension GL_GOOGLE_include_directive : require
// Each texel is a ray from the light whose hit the rasteriser found; it carries the light through the texel.
#include "shaders/linear_index.glsl"
#include "shaders/scene.glsl"
#include "shaders/shared/light_path.h"
#include "shaders/shared/ray_types.h"
#include "passes/inject_rsm/rsm_view.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 16, scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(set = 0, binding = 17, scalar) writeonly buffer Hits { Hit data[]; } hits;
layout(set = 0, binding = 18, scalar) writeonly buffer Paths { LightPath data[]; } paths;
layout(set = 0, binding = 19, rgba32ui) readonly uniform uimage2D seen;

void main() {
    const uint i = linearIndex();
    if (i >= push.texels) return;
    const uint texel = push.firstTexel + i;
    const ivec2 at = ivec2(texel % push.resolution, texel / push.resolution);
    const vec2 onView = ((vec2(at) + 0.5) * (2.0 / float(push.resolution)) - 1.0) * push.halfExtent;
    const float side = 2.0 * push.halfExtent / float(push.resolution);
    const vec3 across = onView.x * push.right + onView.y * push.up;
    const GpuLight light = sceneLights.data[push.light];

    // The beam through the texel: E * area, or I * solid angle (of the texel's middle; exact as texels shrink).
    Ray ray;
    LightPath path = LightPath(vec3(0.0), 0.0, 0.0, 0.0);
    if (push.parallel != 0u) {
        ray.origin = push.origin + across;
        ray.direction = push.forward;
        path.area = side * side;
        path.power = light.intensity * path.area;
    } else {
        ray.origin = push.origin;
        ray.direction = normalize(push.forward + across);
        path.solidAngle = side * side * pow(1.0 + dot(onView, onView), -1.5);
        path.power = light.intensity * path.solidAngle;
        if (light.type == LIGHT_SPOT) path.power *= spotFalloff(light, dot(ray.direction, light.direction));
    }
    ray.tMin = 0.0;
    ray.tMax = all(equal(path.power, vec3(0.0))) ? -1.0 : 1.0e30;

    const uvec4 point = imageLoad(seen, at);
    Hit hit = Hit(0.0, point.x, uintBitsToFloat(point.y), uintBitsToFloat(point.z));
    if (hit.triangle != NO_HIT) hit.t = distance(surfacePoint(hit.triangle, vec2(hit.u, hit.v)).position, ray.origin);
    rays.data[i] = ray;
    hits.data[i] = hit;
    paths.data[i] = path;
}
