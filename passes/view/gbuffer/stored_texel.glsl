// Texels of the G-buffer's images, for rays.
#ifndef VOXRAY_GBUFFER_STORED_TEXEL_GLSL
#define VOXRAY_GBUFFER_STORED_TEXEL_GLSL

#include "passes/view/gbuffer/visible_surface.glsl"
#ifdef MOTION
#include "passes/view/gbuffer/previous.glsl"
#endif

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

// @param offset of ray origins, m.
void storePoint(ivec2 texel, uint triangle, vec2 barycentrics, vec3 point, float offset) {
    imageStore(position, texel, vec4(point, offset));
#ifdef MOTION
    imageStore(previous, texel, vec4(previousPosition(triangle, barycentrics), instanceOf(triangle)));
#endif
}

// @param isSingle whether the pixel shows nothing else (GBuffer::normal).
void storeSurface(ivec2 texel, VisibleSurface s, bool isSingle) {
    imageStore(normal, texel, vec4(s.normal, isSingle ? 1.0 : 0.0));
    imageStore(geometricNormal, texel, vec4(s.geometricNormal, 0.0));
    imageStore(albedo, texel, vec4(s.albedo, 1.0));
    imageStore(emitted, texel, vec4(s.emission, 0.0));
    imageStore(specular, texel, specularTexel(s.specular));
    imageStore(fresnel, texel, fresnelTexel(s.specular));
}

void storeEnvironment(ivec2 texel, vec3 radiance) {
    imageStore(position, texel, vec4(0.0));
    imageStore(normal, texel, vec4(0.0));
    imageStore(geometricNormal, texel, vec4(0.0));
    imageStore(albedo, texel, vec4(0.0));
    imageStore(emitted, texel, vec4(radiance, 0.0));
    imageStore(specular, texel, vec4(0.0));
    imageStore(fresnel, texel, vec4(0.0));
#ifdef MOTION
    imageStore(previous, texel, vec4(0.0));
#endif
}

#endif
