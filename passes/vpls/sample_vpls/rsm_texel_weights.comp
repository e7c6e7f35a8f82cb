// Sampling weights of an RSM's texels: the flux that the point in each reflects, in fixed point.
#include "shaders/compute/linear_index.glsl"
#include "passes/inject/light_paths/light_bounce.glsl"
#include "passes/inject/light_paths/rsm_light.glsl"
#include "shaders/lights/rsm.glsl"
layout(local_size_x = 64) in;

writeonly buffer Weights { uint data[]; } weights;
layout(push_constant, scalar) uniform Push {
    uint resolution;  // Texels along an edge.
    uint firstView;
    uint texels;  // Of all views of the light.
    float unitsPerWatt;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.texels) return;
    const uint texelsPerView = push.resolution * push.resolution, view = push.firstView + i / texelsPerView;
    const ivec2 texel = ivec2(i % push.resolution, i % texelsPerView / push.resolution);
    const RsmView rsmView = rsmViews.data[view];
    const RsmTexel rsmPoint = rsmTexel(view, push.resolution, texel);
    float flux = 0.0;
    if (rsmPoint.triangle != NO_HIT) {
        LightPath path;
        rsmRay(rsmView.view, sceneLights.data[rsmView.light], push.resolution, texel, path);
        const SurfacePoint s = surfacePoint(rsmPoint.triangle, rsmPoint.barycentrics);
        const vec3 reflected = path.power * diffuseReflectance(sceneMaterials.data[s.material], s);
        if (dot(s.geometricNormal, s.geometricNormal) > 0.0) flux = max(reflected.r, max(reflected.g, reflected.b));
    }
    // At least 1 where light is reflected
    weights.data[i] = flux > 0.0 ? 1u + uint(flux * push.unitsPerWatt) : 0u;
}
