// Writes the surfaces that a batch of camera rays hit to the G-buffer's images; with LISTED those of listed pixels of the
// batch.
#include "passes/view/gbuffer/sample_direction.glsl"
#include "passes/view/gbuffer/sampled_texel.glsl"
#include "passes/view/gbuffer/stored_texel.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/inset_barycentrics.glsl"
#include "shaders/trace/ray_types.h"
#ifdef LISTED
#include "shaders/compute/indirect_list.glsl"
#endif
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(push_constant, scalar) uniform Push {
    CameraView view;
    uint seed;  // Of the frame.
    uint firstRay;
    uint batchRays;
} push;

void main() {
#ifdef LISTED
    const uint thread = gl_GlobalInvocationID.x;
    if (thread / TEXELS >= listedItems()) return;
    const uint i = indirectList.items[thread / TEXELS] * TEXELS + thread % TEXELS;
#else
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
#endif
    const ivec2 texel = sampledTexel(push.firstRay + i, push.view.width);
    const Hit hit = hits.data[i];
    if (hit.triangle == NO_HIT) {
        storeEnvironment(texel, environmentRadiance(sampleDirection(push.view, uvec2(texel), SAMPLES, push.seed)));
        return;
    }
    const vec2 barycentrics = insetBarycentrics(hit.triangle, vec2(hit.u, hit.v));
    const SurfacePoint s = surfacePoint(hit.triangle, barycentrics);
    storePoint(texel, hit.triangle, barycentrics, s.position, s.offset);
    storeSurface(texel, visibleSurface(push.view, s), false);
}
