// One level of the edge-avoiding à-trous wavelet filter (Dammertz et al. 2010) over irradiance: 3 x 3 taps, 2^level pixels apart.
// In place of their edge-stopping functions, and of SVGF's (Schied et al. 2017), each tap's weight balances noise against bias:
//
//     weight = kernel * noise / (noise + bias²)
//
// noise: variance of the two elements' values, the mean of both, so that neither takes more from the other than it gives: a weight
//   that depended on one alone would move energy to where light is even. One ray's variance (statistics.comp) over the number
//   of rays that the value stands for, which grows from level to level. Few rays: a wide filter. Many: a narrow one, in the limit
//   none.
// bias²: what the elements' irradiance may differ by, in the mean square. The sum of
//   - what geometry and hits bound: along the surface the distance times the gradient bound (statistics.comp), and over a change of
//     normal one ray's standard deviation times sqrt((1 - cos) / cos), which for small angles is the bound of Ward et al. 1988.
//     Both add up the changes of all surroundings as if none canceled another, so the edge-stopping scale is mostly below 1;
//   - what elements of different surfaces differ by that know nothing of each other (UNRELATED);
//   - what the means of their surroundings (mean.comp) do differ by, beyond the noise of these means.
#include "passes/view/filter_irradiance/surface_light.glsl"
#include "passes/view/filter_irradiance/elements.glsl"

uniform sampler2D light;
uniform sampler2D source;  // Irradiance, W/m²; number of rays that it stands for.
layout(rgba32f) writeonly uniform image2D result;  // Likewise.
layout(push_constant) uniform Push {
    int level;
    float edgeStoppingScale;
} push;

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
    const SurfaceLight centerLight = unpackLight(texelFetch(light, element, 0));
    const float centerNoise = centerLight.rayVariance / max(texelFetch(source, element, 0).w, 1e-3);
    vec3 sum = vec3(0.0);
    float weights = 0.0, squaredWeights = 0.0;  // The latter over the taps' rays.
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 pixel = ivec2(element.x, element.y % pixels.y) + (ivec2(x, y) << push.level);
            if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, pixels))) continue;
            for (int layer = 0, layers = 1; layer < layers; ++layer) {
                const ivec2 at = pixel + ivec2(0, layer * pixels.y);
                const uvec4 neighborBits = texelFetch(surfaces, at, 0);
                const float area = areaOf(neighborBits);
                if (area == 0.0) continue;
                if (area < 1.0) layers = LAYERS;
                const vec4 value = texelFetch(source, at, 0);
                if (value.w == 0.0) continue;
                const Surface other = unpackSurface(neighborBits);
                const SurfaceLight neighborLight = unpackLight(texelFetch(light, at, 0));
                const float bias2 = squaredBias(own, centerLight, other, neighborLight, push.edgeStoppingScale);

                // An element counts as its area does. At level 0 its rays do, which are as many; later the number of rays that a
                // value stands for tells how even light is there, and must not decide how much the value counts.
                const float noise = 0.5 * (centerNoise + neighborLight.rayVariance / value.w);
                const float count = kernel(x, y) * (push.level == 0 ? value.w : area);
                const float weight = count * (bias2 > 0.0 ? noise / (noise + bias2) : 1.0);
                sum += weight * value.rgb;
                weights += weight;
                squaredWeights += weight * weight / value.w;
            }
        }

    // A weighted mean of values with 1/w the variance of one ray has the variance sum(weight² / w) / sum(weight)², were they
    // independent.
    const float rays = weights * weights / (overlap(push.level) * squaredWeights);
    imageStore(result, element, weights > 0.0 ? vec4(sum / weights, rays) : vec4(0.0));
}
