// Finds at most two surfaces in each pixel (elements.glsl) and averages their texels. The first is the surface with
// most of the pixel's rays, and among those with equally many the one with most texels. The second is found in the same
// way among the remaining texels, and represents all of them.
//
// Most pixels show one surface. The others, but for those without any, are listed for the same program with LISTED, and
// they alone have second elements. With READS_ALL_SECOND those of all other pixels are cleared.
#include "passes/view/filter_irradiance/surface.glsl"
#include "shaders/compute/indirect_list.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D irradiance;
uniform sampler2D albedo;
layout(rgba32ui) writeonly uniform uimage2D surfaces;
layout(rgba32f) writeonly uniform image2D source;       // Irradiance, W/m²; number of rays.
// Albedo times the surface's fraction of the pixel; a: 1 where the pixel shows more.
layout(rgba16f) writeonly uniform image2D reflectance;
#ifdef KEEPS_LIGHT
// What the texels with rays reflect of their own irradiance, times the surface's fraction of the pixel; their irradiance
// alone unless ALBEDO_VARIES. a: 1 if there are such texels.
layout(rgba32f) writeonly uniform image2D own;
#endif
layout(push_constant) uniform Push { uvec2 pixels; } push;

#define TEXELS (SAMPLES * SAMPLES)  // Of a pixel.
#define LAYERS (SAMPLES > 1 ? 2 : 1)

ivec2 texelOf(ivec2 pixel, int t) { return pixel * SAMPLES + ivec2(t % SAMPLES, t / SAMPLES); }

Surface surfaceOf(ivec2 texel) {
    return Surface(texelFetch(position, texel, 0).xyz, texelFetch(geometricNormal, texel, 0).xyz,
                   texelFetch(normal, texel, 0).xyz);
}

// Sums over the texels of an element.
struct ElementSums {
    Surface surface;
    vec3 light;  // Irradiance times rays.
    float rays;
    vec3 color;
    vec3 reflected;  // Light times albedo.
};

ElementSums emptySums() {
    return ElementSums(Surface(vec3(0.0), vec3(0.0), vec3(0.0)), vec3(0.0), 0.0, vec3(0.0), vec3(0.0));
}

void storeElement(ivec2 element, ElementSums sums, int texels) {
    const uvec4 surface = packSurface(sums.surface, float(texels) / float(TEXELS));
    imageStore(surfaces, element, texels > 0 ? surface : uvec4(0u));
    imageStore(source, element, vec4(sums.light / max(sums.rays, 1.0), sums.rays));
    imageStore(reflectance, element, vec4(sums.color / float(TEXELS), texels % TEXELS > 0 ? 1.0 : 0.0));
#ifdef KEEPS_LIGHT
#ifdef ALBEDO_VARIES
    const vec3 light = float(texels) / float(TEXELS) * sums.reflected;
#else
    const vec3 light = sums.light;
#endif
    imageStore(own, element, vec4(light / max(sums.rays, 1.0), sums.rays > 0.0 ? 1.0 : 0.0));
#endif
}

// Stores the only surface of a pixel, or that it has none; false where it has several, or texels without any.
bool storeOneSurface(ivec2 pixel) {
    const ivec2 corner = pixel * SAMPLES;
    const Surface first = surfaceOf(corner);
    const vec3 color = texelFetch(albedo, corner, 0).rgb;
    const bool isKnown = texelFetch(normal, corner, 0).w > 0.0;
    ElementSums sums = emptySums();
    bool isOne = true, isNone = true;
    for (int t = 0; t < TEXELS; ++t) {
        const ivec2 texel = texelOf(pixel, t);
        const vec4 point = texelFetch(position, texel, 0), value = texelFetch(irradiance, texel, 0);
        isNone = isNone && point.w == 0.0;
        sums.surface.position += point.xyz / float(TEXELS);
        sums.light += value.w * value.rgb;
        sums.rays += value.w;
        if (isKnown) {
            sums.surface.normal += first.normal;
            sums.surface.geometricNormal += first.geometricNormal;
            sums.color += color;
            sums.reflected += value.w * value.rgb * color;
        } else {
            const Surface s = Surface(point.xyz, texelFetch(geometricNormal, texel, 0).xyz,
                                      texelFetch(normal, texel, 0).xyz);
            isOne = isOne && point.w > 0.0 && isSameSurface(first, s);
            sums.surface.normal += s.normal;
            sums.surface.geometricNormal += s.geometricNormal;
            const vec3 albedo_ = texelFetch(albedo, texel, 0).rgb;
            sums.color += albedo_;
            sums.reflected += value.w * value.rgb * albedo_;
        }
    }
    if (isOne || isNone) storeElement(pixel, sums, isOne ? TEXELS : 0);
    return isOne || isNone;
}

void storeSurfaces(ivec2 pixel) {
    // Read the pixel's texels
    Surface texels[TEXELS];
    bool isUnassigned[TEXELS];
    float rays[TEXELS];
    int unassigned = 0;
    for (int t = 0; t < TEXELS; ++t) {
        const ivec2 texel = texelOf(pixel, t);
        texels[t] = surfaceOf(texel);
        rays[t] = texelFetch(irradiance, texel, 0).w;
        isUnassigned[t] = texelFetch(position, texel, 0).w > 0.0;
        unassigned += isUnassigned[t] ? 1 : 0;
    }

    for (int layer = 0; layer < LAYERS; ++layer) {
        const ivec2 element = pixel + ivec2(0, layer * int(push.pixels.y));
        if (unassigned == 0) {
            storeElement(element, emptySums(), 0);
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
        ElementSums sums = emptySums();
        int area = 0;  // Texels.
        for (int b = 0; b < TEXELS; ++b) {
            if (!isUnassigned[b]) continue;
            const ivec2 texel = texelOf(pixel, b);
            const bool same = isSameSurface(texels[best], texels[b]);
            if (same) {
                sums.surface.position += texels[b].position / float(bestTexels);
                sums.surface.normal += texels[b].normal;
                sums.surface.geometricNormal += texels[b].geometricNormal;
            }
            if (same || layer == 1) {
                const vec3 light = rays[b] * texelFetch(irradiance, texel, 0).rgb;
                const vec3 albedo_ = texelFetch(albedo, texel, 0).rgb;
                sums.light += light;
                sums.rays += rays[b];
                ++area;
                sums.color += albedo_;
                sums.reflected += light * albedo_;
                isUnassigned[b] = false;
                --unassigned;
            }
        }
        storeElement(element, sums, area);
    }
}

#ifdef LISTED
void main() {
    if (gl_GlobalInvocationID.x >= listedItems()) return;
    const uint item = indirectList.items[gl_GlobalInvocationID.x];
    storeSurfaces(ivec2(item & 0xffffu, item >> 16));
}
#else
void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), push.pixels))) return;
    if (!storeOneSurface(pixel)) appendItem(uint(pixel.x) | (uint(pixel.y) << 16), 1u);
#ifdef READS_ALL_SECOND
    imageStore(surfaces, pixel + ivec2(0, push.pixels.y), uvec4(0u));
#endif
}
#endif
