// Rays of a spot light through the points of a planar grid that spans 90 degrees about its axis, with the light's
// intensity in their direction.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Intensities { vec3 data[]; } intensities;
layout(push_constant, scalar) uniform Push {
    uint light;
    uint raysPerEdge;
    uint firstRay;
    uint batchRays;
    float tMin;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uint rayIndex = push.firstRay + i;
    const GpuLight light = sceneLights.data[push.light];
    vec3 right, up;
    frame(light.direction, right, up);

    // Listing 4.4: the ray's position in the grid minus half of the grid, which is also the grid's distance
    const float halfEdge = 0.5 * float(push.raysPerEdge);
    const vec2 gridPoint = vec2(rayIndex % push.raysPerEdge, rayIndex / push.raysPerEdge) - halfEdge;
    const vec3 direction = normalize(gridPoint.x * right + gridPoint.y * up + halfEdge * light.direction);

    // Rays outside of the light's cone are inactive
    const float falloff = spotFalloff(light, dot(direction, light.direction));
    intensities.data[i] = light.intensity * falloff;
    rays.data[i] = Ray(light.position, push.tMin, direction, falloff > 0.0 ? 1.0e30 : -1.0);
}
