// Writes the surfaces that a batch of camera rays hit to the G-buffer's images.
#include "passes/view/gbuffer/sample_direction.glsl"
#include "passes/view/gbuffer/visible_surface.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/inset_barycentrics.glsl"
#include "shaders/trace/ray_types.h"
#ifdef MOTION
#include "passes/view/gbuffer/previous.glsl"
#endif
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(rgba32f) writeonly uniform image2D position;
layout(rgba16f) writeonly uniform image2D normal;
layout(rgba16f) writeonly uniform image2D geometricNormal;
layout(rgba16f) writeonly uniform image2D albedo;
layout(rgba32f) writeonly uniform image2D emitted;
layout(rgba16f) writeonly uniform image2D specular;
layout(rgba8) writeonly uniform image2D fresnel;
#ifdef MOTION
layout(rgba32f) writeonly uniform image2D previous;
#endif
layout(push_constant, scalar) uniform Push {
    CameraView view;
    uint samples;
    uint seed;  // Of the frame.
    uint firstTexel;
    uint batchRays;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uint index = push.firstTexel + i;
    const ivec2 texel = ivec2(index % push.view.width, index / push.view.width);
    const Hit hit = hits.data[i];

    vec4 point = vec4(0.0), previousPoint = vec4(0.0);
    VisibleSurface visible = VisibleSurface(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0),
                                            Specular(vec3(0.0), 0.0, 0.0, 0.0, 0.0));
    if (hit.triangle == NO_HIT) {
        visible.emission = environmentRadiance(sampleDirection(push.view, uvec2(texel), push.samples, push.seed));
    } else {
        const vec2 barycentrics = insetBarycentrics(hit.triangle, vec2(hit.u, hit.v));
        const SurfacePoint s = surfacePoint(hit.triangle, barycentrics);
        point = vec4(s.position, s.offset);
        visible = visibleSurface(push.view, s);
#ifdef MOTION
        previousPoint = vec4(previousPosition(hit.triangle, barycentrics), instanceOf(hit.triangle));
#endif
    }
    imageStore(position, texel, point);
    imageStore(normal, texel, vec4(visible.normal, 0.0));
    imageStore(geometricNormal, texel, vec4(visible.geometricNormal, 0.0));
    imageStore(albedo, texel, vec4(visible.albedo, hit.triangle == NO_HIT ? 0.0 : 1.0));
    imageStore(emitted, texel, vec4(visible.emission, 0.0));
    imageStore(specular, texel, specularTexel(visible.specular));
    imageStore(fresnel, texel, fresnelTexel(visible.specular));
#ifdef MOTION
    imageStore(previous, texel, previousPoint);
#endif
}
