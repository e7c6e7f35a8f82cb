// The flux that the point reflects which each texel of a light's maps sees, as a whole number: what it is picked by.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/light_bounce.glsl"
#include "passes/inject/light_paths/rsm_light.glsl"
#include "shaders/lights/rsm.glsl"
layout(local_size_x = 64) in;

writeonly buffer Weights { uint data[]; } weights;
layout(push_constant, scalar) uniform Push {
    uint resolution;  // Texels a side.
    uint firstView;
    uint texels;  // Of all views of the light.
    float unitsPerWatt;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.texels) return;
    const uint perView = push.resolution * push.resolution, view = push.firstView + i / perView;
    const ivec2 at = ivec2(i % push.resolution, i % perView / push.resolution);
    const RsmView v = rsmViews.data[view];
    const RsmTexel seen = rsmTexel(view, push.resolution, at);
    float flux = 0.0;
    if (seen.triangle != NO_HIT) {
        LightPath path;
        rsmRay(v.view, sceneLights.data[v.light], push.resolution, at, path);
        const SurfacePoint s = surfacePoint(seen.triangle, seen.barycentrics);
        const vec3 reflected = path.power * litAlbedo(sceneMaterials.data[s.material], s);
        if (dot(s.geometricNormal, s.geometricNormal) > 0.0) flux = max(reflected.r, max(reflected.g, reflected.b));
    }
    // However little it is, it has a weight
    weights.data[i] = flux > 0.0 ? 1u + uint(flux * push.unitsPerWatt) : 0u;
}
