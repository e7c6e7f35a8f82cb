// Finds at most two surfaces in each pixel (elements.glsl) and averages their texels. The first is the surface with
// most of the pixel's rays, and among those with equally many the one with most texels. The second is found in the same
// way among the remaining texels, and represents all of them.
#include "passes/view/filter_irradiance/surface.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D irradiance;
uniform sampler2D albedo;
layout(rgba32ui) writeonly uniform uimage2D surfaces;
layout(rgba32f) writeonly uniform image2D source;       // Irradiance, W/m²; number of rays.
layout(rgba16f) writeonly uniform image2D reflectance;  // Albedo times the surface's fraction of the pixel.
layout(scalar) buffer Second { uint data[]; } second;   // Number of second surfaces, then their pixels, in any order.
layout(push_constant) uniform Push { uvec2 pixels; } push;

#define TEXELS (SAMPLES * SAMPLES)  // Of a pixel.
#define LAYERS (SAMPLES > 1 ? 2 : 1)

ivec2 texelOf(ivec2 pixel, int t) { return pixel * SAMPLES + ivec2(t % SAMPLES, t / SAMPLES); }

void main() {
    const uint i = linearIndex();
    if (i >= push.pixels.x * push.pixels.y) return;
    const ivec2 pixel = ivec2(i % push.pixels.x, i / push.pixels.x);

    // Read the pixel's texels
    Surface texels[TEXELS];
    bool isUnassigned[TEXELS];
    float rays[TEXELS];
    int unassigned = 0;
    for (int t = 0; t < TEXELS; ++t) {
        const ivec2 texel = texelOf(pixel, t);
        const vec4 p = texelFetch(position, texel, 0);
        texels[t] = Surface(p.xyz, texelFetch(geometricNormal, texel, 0).xyz, texelFetch(normal, texel, 0).xyz);
        rays[t] = texelFetch(irradiance, texel, 0).w;
        isUnassigned[t] = p.w > 0.0;
        unassigned += isUnassigned[t] ? 1 : 0;
    }

    for (int layer = 0; layer < LAYERS; ++layer) {
        const ivec2 element = pixel + ivec2(0, layer * int(push.pixels.y));
        if (unassigned == 0) {
            imageStore(surfaces, element, uvec4(0u));
            imageStore(source, element, vec4(0.0));
            imageStore(reflectance, element, vec4(0.0));
            continue;
        }

        // Select the surface with most rays
        int best = 0, bestTexels = 0;
        float bestRays = -1.0;
        for (int a = 0; a < TEXELS && bestTexels < unassigned; ++a) {
            if (!isUnassigned[a]) continue;
            float groupRays = 0.0;
            int groupTexels = 0;
            for (int b = 0; b < TEXELS; ++b) {
                const bool same = isUnassigned[b] && isSameSurface(texels[a], texels[b]);
                groupRays += same ? rays[b] : 0.0;
                groupTexels += same ? 1 : 0;
            }
            if (groupRays > bestRays || (groupRays == bestRays && groupTexels > bestTexels)) {
                best = a;
                bestRays = groupRays;
                bestTexels = groupTexels;
            }
        }

        // Average its geometry, irradiance and albedo; light and albedo of the second surface over all remaining texels
        Surface mean_ = Surface(vec3(0.0), vec3(0.0), vec3(0.0));
        vec3 light = vec3(0.0), color = vec3(0.0);
        float lightRays = 0.0;
        int area = 0;  // Texels.
        for (int b = 0; b < TEXELS; ++b) {
            if (!isUnassigned[b]) continue;
            const ivec2 texel = texelOf(pixel, b);
            const bool same = isSameSurface(texels[best], texels[b]);
            if (same) {
                mean_.position += texels[b].position / float(bestTexels);
                mean_.normal += texels[b].normal;
                mean_.geometricNormal += texels[b].geometricNormal;
            }
            if (same || layer == 1) {
                light += rays[b] * texelFetch(irradiance, texel, 0).rgb;
                lightRays += rays[b];
                ++area;
                color += texelFetch(albedo, texel, 0).rgb;
                isUnassigned[b] = false;
                --unassigned;
            }
        }
        imageStore(surfaces, element, packSurface(mean_, float(area) / float(TEXELS)));
        imageStore(source, element, vec4(light / max(lightRays, 1.0), lightRays));
        imageStore(reflectance, element, vec4(color / float(TEXELS), 0.0));
        if (layer == 1) second.data[1u + atomicAdd(second.data[0], 1u)] = i;
    }
}
