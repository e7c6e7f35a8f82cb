// Multiplies each pixel's diffuse light by the factor of its tile, and with SPECULAR adds what specular lobes reflect.
#include "shaders/filter/block_interpolation.glsl"
#include "shaders/filter/tiles.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2D result;
layout(scalar) readonly buffer Raised { vec3 data[]; } raised;  // kept_light.comp
#ifdef SPECULAR
uniform sampler2D reflected;
layout(push_constant) uniform Push { int samples; } push;

vec3 reflectedOf(ivec2 pixel) {
    vec3 sum = vec3(0.0);
    for (int y = 0; y < push.samples; ++y)
        for (int x = 0; x < push.samples; ++x)
            sum += texelFetch(reflected, pixel * push.samples + ivec2(x, y), 0).rgb;
    return sum / float(push.samples * push.samples);
}
#endif

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
    if (any(greaterThanEqual(pixel, size))) return;
    const BlockCorner corners[4] = blockCorners(pixel, float(TILE), tilesOf(uvec2(size)));
    vec3 factor = vec3(0.0);
    for (int i = 0; i < 4; ++i) factor += corners[i].weight * raised.data[corners[i].block];
    vec3 light = factor * imageLoad(result, pixel).rgb;
#ifdef SPECULAR
    light += reflectedOf(pixel);
#endif
    imageStore(result, pixel, vec4(light, 1.0));
}
