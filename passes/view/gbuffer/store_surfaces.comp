// Writes the surfaces that a batch of camera rays hit to the G-buffer's images; with LISTED those of listed items of
// LISTED rays each, the samples of a pixel or one. With LISTS_TEXTURED only those without textures; the other rays are
// listed. Devices that compute both sides of a branch then read textures only where there are some.
#include "passes/view/gbuffer/sample_direction.glsl"
#include "passes/view/gbuffer/sampled_texel.glsl"
#include "passes/view/gbuffer/stored_texel.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/inset_barycentrics.glsl"
#include "shaders/trace/ray_types.h"
#if defined(LISTED) || defined(LISTS_TEXTURED)
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
    if (thread / LISTED >= listedItems()) return;
    const uint i = indirectList.items[thread / LISTED] * LISTED + thread % LISTED;
#else
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
#endif
    const ivec2 texel = sampledTexel(push.firstRay + i, push.view.width);
    const Hit hit = hits.data[i];
#ifdef LISTS_TEXTURED
    if (hit.triangle == NO_HIT || isTextured(sceneMaterials.data[triangleMaterial(hit.triangle)])) {
        appendItem(i, 1u);
        return;
    }
    VisibleSurface visible;
#else
    VisibleSurface visible =
        noSurface(environmentRadiance(sampleDirection(push.view, uvec2(texel), SAMPLES, push.seed)));
#endif
    const bool isHit = hit.triangle != NO_HIT;
    vec4 point = vec4(0.0), previous_ = vec4(0.0);
    if (isHit) {
        const vec2 barycentrics = insetBarycentrics(hit.triangle, vec2(hit.u, hit.v));
        const SurfacePoint s = surfacePoint(hit.triangle, barycentrics);
        point = vec4(s.position, s.offset);
        previous_ = previousPoint(hit.triangle, barycentrics);
        visible = visibleSurface(push.view, s);
    }
    // One store of an image for both: lavapipe calls a function for each
    storePoint(texel, point, previous_);
    storeSurface(texel, visible, isHit, false);
}
