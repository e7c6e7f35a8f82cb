// Takes means of wider surroundings (mean.comp) into the light of elements, for the next level.
#include "passes/view/filter_irradiance/elements.glsl"
#include "passes/view/filter_irradiance/surface_light.glsl"
layout(local_size_x = 64) in;

uniform sampler2D mean;
layout(rgba32f) uniform image2D light;  // surface_light.glsl

void main() {
    const ivec2 element = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(element, imageSize(light))) || areaOf(texelFetch(surfaces, element, 0)) == 0.0) return;
    SurfaceLight found = unpackLight(imageLoad(light, element));
    setMean(found, texelFetch(mean, element, 0).xyz);
    imageStore(light, element, packLight(found));
}
