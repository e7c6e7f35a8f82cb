// Rays of a spot light through the points of a planar grid that spans 90 degrees about its axis, with the light's intensity there.
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
    float nearest;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uint number = push.firstRay + i;
    const GpuLight light = sceneLights.data[push.light];
    vec3 across, up;
    frame(light.direction, across, up);

    // Listing 4.4: the ray's number in the grid less half of the grid, which is also how far away the grid is
    const float halfEdge = 0.5 * float(push.raysPerEdge);
    const vec2 place = vec2(number % push.raysPerEdge, number / push.raysPerEdge) - halfEdge;
    const vec3 direction = normalize(place.x * across + place.y * up + halfEdge * light.direction);

    // Outside of the light's cone there is nothing to carry
    const float falloff = spotFalloff(light, dot(direction, light.direction));
    intensities.data[i] = light.intensity * falloff;
    rays.data[i] = Ray(light.position, push.nearest, direction, falloff > 0.0 ? 1.0e30 : -1.0);
}
