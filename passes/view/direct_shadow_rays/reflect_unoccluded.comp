// Adds the radiance that a batch of pixels reflects of unoccluded shadow rays, averaged over the texels of each pixel.
// SPLIT: writes the radiance that filter_irradiance leaves as it is, too. That is all of it for punctual lights with a
// ray each; for samples of other sources (HITS) it is the reflection of specular lobes, and the irradiance of the
// diffuse layer is added to that of the texel, with the moments of its rays.
#include "passes/view/direct_shadow_rays/shadow_ray_light.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/scene/specular.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
uniform sampler2D specular;
uniform sampler2D fresnel;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer RayLight { ShadowRayLight data[]; } rayLight;
layout(rgba32f) uniform image2D direct;
#ifdef SPLIT
layout(rgba32f) uniform image2D unfiltered;
#endif
#ifdef HITS
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(rgba32f) uniform image2D irradiance;    // W/m²; number of rays.
layout(rgba32f) uniform image2D texelMoments;  // Sums of L²; change, hidden and hiddenChange.
#else
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
#endif
layout(push_constant, scalar) uniform Push {
    uint width;  // Pixels of a row.
    uint firstPixel;
    uint batchPixels;
    uint samples;  // Texels along an edge of a pixel.
    uint raysPerTexel;
    uint lightSamples;
    vec3 camera;
    float pixelAngle;  // Width of a pixel at unit distance.
} push;

bool isOccluded(uint ray) {
#ifdef HITS
    return hits.data[ray].triangle != NO_HIT;
#else
    return occluded.data[ray] != 0u;
#endif
}

#ifdef HITS
// Of a ray: change, hidden and hiddenChange. The light of an emissive surface changes by all of itself over the distance
// from its plane. The edge of an occluder at distance t crosses the solid angle that the ray stands for in t times its
// width. Changes within a pixel count as if they took all of it.
vec3 changeOf(uint ray, float pixelWidth) {
    const ShadowRayLight light = rayLight.data[ray];
    const float l = luminance(light.irradiance);
    if (!isOccluded(ray)) return vec3(l * min(light.inverseHeight, 1.0 / pixelWidth), 0.0, 0.0);
    return vec3(0.0, l, l / max(hits.data[ray].t * light.width, pixelWidth));
}
#endif

void main() {
    const uint i = linearIndex();
    if (i >= push.batchPixels) return;
    const uint pixel = push.firstPixel + i, texels = push.samples * push.samples;
    const ivec2 at = ivec2(pixel % push.width, pixel / push.width);
    vec3 reflected = vec3(0.0), lobes = vec3(0.0);
    for (uint t = 0u; t < texels; ++t) {
        const ivec2 texel = at * int(push.samples) + ivec2(t % push.samples, t / push.samples);
        const vec4 p = texelFetch(position, texel, 0);
        if (p.w == 0.0) continue;
        const vec3 out_ = normalize(push.camera - p.xyz), diffuse = texelFetch(albedo, texel, 0).rgb;
        const Specular surface = specularOf(texelFetch(specular, texel, 0), texelFetch(fresnel, texel, 0));
        vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
        if (hasSpecular(surface)) n = specularNormal(n, out_);

#ifdef HITS
        const float pixelWidth = push.pixelAngle * distance(push.camera, p.xyz);
#endif
        vec3 diffuseLight = vec3(0.0);  // W/m²
        vec3 changes = vec3(0.0);       // changeOf() of all rays.
        for (uint k = 0u; k < push.raysPerTexel; ++k) {
            const uint ray = (i * texels + t) * push.raysPerTexel + k;
#ifdef HITS
            changes += changeOf(ray, pixelWidth);
#endif
            if (isOccluded(ray)) continue;
            const vec3 light = rayLight.data[ray].irradiance, direction = rays.data[ray].direction;
            if (hasSpecular(surface)) lobes += light * reflectance(vec3(0.0), surface, n, out_, direction);
            diffuseLight += light * diffuseTransmittance(surface, out_, direction);
        }
        reflected += diffuseLight * diffuse / PI;
#ifdef HITS
        // A black texel has no rays: their light is not known
        if (all(equal(diffuse, vec3(0.0)))) continue;
        const float samples = float(push.lightSamples), l = luminance(diffuseLight) * samples;
        const vec4 sum = imageLoad(irradiance, texel);
        imageStore(irradiance, texel, sum + vec4(diffuseLight, 1.0));
        imageStore(texelMoments, texel, imageLoad(texelMoments, texel) + vec4(l * l, changes * samples));
#endif
    }
    const float perPixel = float(texels);
    imageStore(direct, at, imageLoad(direct, at) + vec4((reflected + lobes) / perPixel, 0.0));
#ifdef SPLIT
#ifdef HITS
    const vec3 kept = lobes;
#else
    const vec3 kept = reflected + lobes;
#endif
    imageStore(unfiltered, at, imageLoad(unfiltered, at) + vec4(kept / perPixel, 0.0));
#endif
}
