// One level of an edge-avoiding à-trous wavelet (Dammertz et al. 2010) with geometric edge-stopping only: the mean
// irradiance of an element's neighborhood on the same surface. wavelet.comp compares these means to detect changes of
// light.
#include "passes/view/filter_irradiance/elements.glsl"
#include "shaders/scene/sampling.glsl"

// At level 0 irradiance and number of rays, then the result of the previous level.
uniform sampler2D source;
// Mean luminance, W/m²; rays per pixel; sum of their squared weights: the mean has the variance of rays² / squares
// rays.
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

    const Surface center = unpackSurface(bits);
    float luminances = 0.0, rays = 0.0, squares = 0.0, weights = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 pixel = ivec2(element.x, element.y % pixels.y) + (ivec2(x, y) << push.level);
            if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, pixels))) continue;
            for (int layer = 0, layers = 1; layer < layers; ++layer) {
                const ivec2 tap = pixel + ivec2(0, layer * pixels.y);
                const uvec4 neighbor = texelFetch(surfaces, tap, 0);
                const float area = areaOf(neighbor);
                if (area == 0.0) continue;
                if (area < 1.0) layers = LAYERS;
                // At level 0 the number of rays is that of the element, later per pixel
                const vec4 value = texelFetch(source, tap, 0);
                const vec3 light = push.level == 0 ? vec3(luminance(value.rgb), value.aa) : value.rgb;
                const float same = kernel(x, y) * sameSurface(center, unpackSurface(neighbor));
                const float weight = push.level == 0 ? same : same * area;
                luminances += weight * light.y * light.x;
                rays += weight * light.y;
                squares += weight * weight * light.z;
                weights += same * area;
            }
        }

    const float meanSquares = overlap(push.level) * squares / (weights * weights);
    imageStore(result, element, vec4(rays > 0.0 ? luminances / rays : 0.0, rays / weights, meanSquares, 0.0));
}
