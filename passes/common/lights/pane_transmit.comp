// Transmits rays through the panes that they hit: scales their throughput and advances them. The bound scene is that of
// the panes.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) buffer PaneRays { Ray data[]; } paneRays;
layout(scalar) readonly buffer PaneHits { Hit data[]; } paneHits;
buffer Throughput { float data[]; } throughput;
buffer Active { uint count; } active_;
layout(push_constant) uniform Push {
    uint count;
    uint stride;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Ray ray = paneRays.data[i];
    if (ray.tMax < ray.tMin) return;
    const Hit hit = paneHits.data[i];
    if (hit.triangle == NO_HIT) {
        paneRays.data[i].tMax = -1.0;
        return;
    }
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    const GpuMaterial m = sceneMaterials.data[s.material];
    const vec3 transmittance = m.transmission * diffuseAlbedo(m, s, 0.0);
    for (uint c = 0u; c < 3u; ++c) throughput.data[i * push.stride + c] *= transmittance[c];

    // Past this pane by more than the rounding error of its distance
    paneRays.data[i].tMin = hit.t * (1.0 + 1e-5);
    atomicAdd(active_.count, 1u);
}
