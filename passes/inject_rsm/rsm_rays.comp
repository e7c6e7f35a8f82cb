#version 460
#extension GL_GOOGLE_include_directive : require
// Each texel is a ray from the light whose hit the rasteriser found; it carries the light through the texel.
#include "shaders/lights/light_view.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/light_paths/light_path_types.h"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer Paths { LightPath data[]; } paths;
layout(rgba32ui) readonly uniform uimage2D seen;
layout(push_constant, scalar) uniform Push {
    LightView view;
    uint light;
    uint resolution;  // Texels a side.
    uint firstTexel;
    uint texels;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.texels) return;
    const uint texel = push.firstTexel + i;
    const ivec2 at = ivec2(texel % push.resolution, texel / push.resolution);
    const vec2 onView = texelOnView(push.view, push.resolution, at);
    const float side = texelWidth(push.view, push.resolution);
    const TexelRay beam = texelRay(push.view, onView);
    const GpuLight light = sceneLights.data[push.light];

    // The beam through the texel: E * area, or I * solid angle (of the texel's center; exact as texels shrink).
    Ray ray;
    ray.origin = beam.start;
    ray.direction = normalize(beam.along);
    LightPath path = LightPath(vec3(0.0), 0.0, 0.0, 0.0);
    if (push.view.parallel != 0u) {
        path.area = side * side;
        path.power = light.intensity * path.area;
    } else {
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
