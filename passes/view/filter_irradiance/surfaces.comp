// Finds at most two surfaces in each pixel (elements.glsl) and averages their texels. The first is the surface with
// most of the pixel's rays, and among those with equally many the one with most texels. The second is found in the same
// way among the remaining texels, and represents all of them.
//
// Most pixels show one surface. The others, but for those without any, are listed for the same program with LISTED, and
// they alone have second elements. With READS_ALL_SECOND those of all other pixels are cleared.
#include "passes/view/filter_irradiance/mean.glsl"
#include "shaders/compute/indirect_list.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
uniform sampler2D irradiance;
uniform sampler2D albedo;
layout(scalar) writeonly buffer SurfacesRef { Words3 surfaces; };
layout(scalar) writeonly buffer SourceRef { Words2 source; };  // Irradiance, W/m²; number of rays.
#ifdef STATISTICS
layout(scalar) writeonly buffer MeansRef { Words1 means; };  // Of elements alone.
#endif
// Albedo times the surface's fraction of the pixel; a: 1 where the pixel shows more.
layout(scalar) writeonly buffer ReflectanceRef { Words1 reflectance; };
#ifdef KEEPS_LIGHT
// What the texels with rays reflect of their own irradiance, times the surface's fraction of the pixel; their irradiance
// alone unless ALBEDO_VARIES. a: 1 if there are such texels.
layout(scalar) writeonly buffer OwnRef { Words2 own; };
#endif
layout(push_constant) uniform Push { uvec2 pixels; } push;

#define TEXELS (SAMPLES * SAMPLES)  // Of a pixel.

ivec2 texelOf(ivec2 pixel, int t) { return pixel * SAMPLES + ivec2(t % SAMPLES, t / SAMPLES); }

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

// @param value irradiance and number of rays.
void addLight(inout ElementSums sums, vec4 value, vec3 color) {
    const vec3 light = value.w * value.rgb;
    sums.light += light;
    sums.rays += value.w;
    sums.color += color;
    sums.reflected += light * color;
}

vec3 unit(vec3 v) { return dot(v, v) > 0.0 ? normalize(v) : vec3(0.0); }

// @param sums with sums of positions and normals over `points` texels.
void storeElement(uint element, ElementSums sums, int points, int texels) {
    const float area = float(texels) / float(TEXELS);
    const Surface s = Surface(sums.surface.position / float(max(points, 1)), unit(sums.surface.geometricNormal),
                              unit(sums.surface.normal));
    const vec3 irradiance_ = sums.light / max(sums.rays, 1.0);
    surfaces.data[element] = texels > 0 ? packSurface(s, area) : u64vec3(0);
    source.data[element] = packValues(vec4(irradiance_, sums.rays));
#ifdef STATISTICS
    means.data[element] = packOwnMean(luminance(irradiance_), sums.rays, area);
#endif
    reflectance.data[element] = packHalves(vec4(sums.color / float(TEXELS), texels % TEXELS > 0 ? 1.0 : 0.0));
#ifdef KEEPS_LIGHT
#ifdef ALBEDO_VARIES
    const vec3 light = area * sums.reflected / max(sums.rays, 1.0);
#else
    const vec3 light = irradiance_;
#endif
    own.data[element] = packValues(vec4(light, sums.rays > 0.0 ? 1.0 : 0.0));
#endif
}

// Stores the only surface of a pixel, or that it has none; false where it has several, or texels without any.
bool storeOneSurface(ivec2 pixel) {
    ElementSums sums = emptySums();
    Surface first;
    vec3 color;
    bool isKnown = false, isOne = true, isNone = true;
    for (int t = 0; t < TEXELS; ++t) {
        const ivec2 texel = texelOf(pixel, t);
        const vec4 point = texelFetch(position, texel, 0);
        Surface s = Surface(point.xyz, first.geometricNormal, first.normal);
        if (!isKnown) {
            const vec4 normal_ = texelFetch(normal, texel, 0);
            isKnown = normal_.w > 0.0;
            s.geometricNormal = texelFetch(geometricNormal, texel, 0).xyz;
            s.normal = normal_.xyz;
            color = texelFetch(albedo, texel, 0).rgb;
        }
        if (t == 0) first = s;
        isOne = isOne && point.w > 0.0 && (t == 0 || isKnown || isSameSurface(first, s));
        isNone = isNone && point.w == 0.0;
        sums.surface.position += s.position;
        sums.surface.geometricNormal += s.geometricNormal;
        sums.surface.normal += s.normal;
        addLight(sums, texelFetch(irradiance, texel, 0), color);
    }
    if (isOne || isNone) storeElement(elementOf(pixel, ivec2(push.pixels), 0), sums, TEXELS, isOne ? TEXELS : 0);
    return isOne || isNone;
}

void storeSurfaces(ivec2 pixel) {
    // Read the pixel's texels
    Surface texels[TEXELS];
    vec4 values[TEXELS];  // Irradiance, number of rays.
    vec3 colors[TEXELS];
    bool isUnassigned[TEXELS];
    int unassigned = 0;
    for (int t = 0; t < TEXELS; ++t) {
        const ivec2 texel = texelOf(pixel, t);
        const vec4 point = texelFetch(position, texel, 0);
        texels[t] = Surface(point.xyz, texelFetch(geometricNormal, texel, 0).xyz, texelFetch(normal, texel, 0).xyz);
        values[t] = texelFetch(irradiance, texel, 0);
        colors[t] = texelFetch(albedo, texel, 0).rgb;
        isUnassigned[t] = point.w > 0.0;
        unassigned += isUnassigned[t] ? 1 : 0;
    }

    for (int layer = 0; layer < LAYERS; ++layer) {
        const uint element = elementOf(pixel, ivec2(push.pixels), layer);
        if (unassigned == 0) {
            storeElement(element, emptySums(), 0, 0);
            continue;
        }

        // Select the surface with most rays
        Surface best = texels[0];
        int bestTexels = 0;
        float bestRays = -1.0;
        for (int a = 0; a < TEXELS && bestTexels < unassigned; ++a) {
            if (!isUnassigned[a]) continue;
            float groupRays = 0.0;
            int groupTexels = 0;
            for (int b = 0; b < TEXELS; ++b) {
                const bool same = isUnassigned[b] && isSameSurface(texels[a], texels[b]);
                groupRays += same ? values[b].w : 0.0;
                groupTexels += same ? 1 : 0;
            }
            if (groupRays > bestRays || (groupRays == bestRays && groupTexels > bestTexels)) {
                best = texels[a];
                bestRays = groupRays;
                bestTexels = groupTexels;
            }
        }

        // Average its geometry, irradiance and albedo; light and albedo of the second surface over all remaining texels
        ElementSums sums = emptySums();
        int area = 0;  // Texels.
        for (int b = 0; b < TEXELS; ++b) {
            if (!isUnassigned[b]) continue;
            const bool same = isSameSurface(best, texels[b]);
            if (same) {
                sums.surface.position += texels[b].position;
                sums.surface.normal += texels[b].normal;
                sums.surface.geometricNormal += texels[b].geometricNormal;
            }
            if (same || layer == 1) {
                addLight(sums, values[b], colors[b]);
                ++area;
                isUnassigned[b] = false;
                --unassigned;
            }
        }
        storeElement(element, sums, bestTexels, area);
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
    surfaces.data[elementOf(pixel, ivec2(push.pixels), 1)] = u64vec3(0);
#endif
}
#endif
