// Texels of the G-buffer's images, for rays. With LAMBERT no surface has a specular lobe, with DARK nothing emits light:
// `specular` and `fresnel`, or `emitted`, are then 0 everywhere, and stay as they are.
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
#ifndef DARK
layout(rgba32f) writeonly uniform image2D emitted;
#endif
#ifndef LAMBERT
layout(rgba16f) writeonly uniform image2D specular;
layout(rgba8) writeonly uniform image2D fresnel;
#endif
#ifdef MOTION
layout(rgba32f) writeonly uniform image2D previous;
#endif

// Position in the previous frame, and mesh instance.
vec4 previousPoint(uint triangle, vec2 barycentrics) {
#ifdef MOTION
    return vec4(previousPosition(triangle, barycentrics), instanceOf(triangle));
#else
    return vec4(0.0);
#endif
}

// @param point m; and offset of ray origins, m.
void storePoint(ivec2 texel, vec4 point, vec4 previous_) {
    imageStore(position, texel, point);
#ifdef MOTION
    imageStore(previous, texel, previous_);
#endif
}

// What a ray sees that hits no surface.
VisibleSurface noSurface(vec3 radiance) {
    return VisibleSurface(vec3(0.0), vec3(0.0), vec3(0.0), radiance, Specular(vec3(0.0), 0.0, 0.0, 0.0, 0.0));
}

// @param isSingle whether the pixel shows nothing else (GBuffer::normal).
void storeSurface(ivec2 texel, VisibleSurface s, bool isHit, bool isSingle) {
    imageStore(normal, texel, vec4(s.normal, isSingle ? 1.0 : 0.0));
    imageStore(geometricNormal, texel, vec4(s.geometricNormal, 0.0));
    imageStore(albedo, texel, vec4(s.albedo, isHit ? 1.0 : 0.0));
#ifndef DARK
    imageStore(emitted, texel, vec4(s.emission, 0.0));
#endif
#ifndef LAMBERT
    imageStore(specular, texel, specularTexel(s.specular));
    imageStore(fresnel, texel, fresnelTexel(s.specular));
#endif
}

#endif
