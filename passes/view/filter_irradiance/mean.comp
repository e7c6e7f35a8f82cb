// One level of a plain edge-avoiding à-trous wavelet (Dammertz et al. 2010), stopped by geometry alone: the mean light of an
// element's surroundings on the same surface. Means are compared to tell whether light differs between elements (wavelet.comp).
#include "passes/view/filter_irradiance/elements.glsl"
#include "shaders/scene/sampling.glsl"

// At level 0 irradiance and number of rays, later the result of the level before.
uniform sampler2D source;
// Mean luminance, W/m²; rays of a whole pixel; sum of their squared weights, so that the mean stands for rays² / squares of them.
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant) uniform Push { int level; } push;

void main() {
    const ivec2 pixels = imageSize(result) / ivec2(1, LAYERS);
    ivec2 element;
    if (!elementOfThread(pixels, element)) return;
    const uvec4 bits = texelFetch(surfaces, element, 0);
    if (areaOf(bits) == 0.0) {
        imageStore(result, element, vec4(0.0));
        return;
    }

    const Surface own = unpackSurface(bits);
    float luminances = 0.0, rays = 0.0, squares = 0.0, weights = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 pixel = ivec2(element.x, element.y % pixels.y) + (ivec2(x, y) << push.level);
            if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, pixels))) continue;
            for (int layer = 0, layers = 1; layer < layers; ++layer) {
                const ivec2 at = pixel + ivec2(0, layer * pixels.y);
                const uvec4 other = texelFetch(surfaces, at, 0);
                const float area = areaOf(other);
                if (area == 0.0) continue;
                if (area < 1.0) layers = LAYERS;
                // Rays are as many as an element's area makes them, at level 0; later they are those of a whole pixel.
                const vec4 from = texelFetch(source, at, 0);
                const vec3 light = push.level == 0 ? vec3(luminance(from.rgb), from.aa) : from.rgb;
                const float same = kernel(x, y) * sameSurface(own, unpackSurface(other));
                const float weight = push.level == 0 ? same : same * area;
                luminances += weight * light.y * light.x;
                rays += weight * light.y;
                squares += weight * weight * light.z;
                weights += same * area;
            }
        }

    imageStore(result, element,
               vec4(rays > 0.0 ? luminances / rays : 0.0, rays / weights, overlap(push.level) * squares / (weights * weights), 0.0));
}
