// Radiance that each pixel reflects of the filtered irradiance, by Lambert's law, and of light that is not filtered.
#include "passes/view/filter_irradiance/elements.glsl"
#include "shaders/filter/block_interpolation.glsl"
#include "shaders/filter/tiles.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer IrradianceRef { Words2 irradiance; };    // W/m²
layout(scalar) readonly buffer ReflectanceRef { Words1 reflectance; };  // surfaces.comp
uniform sampler2D unfiltered;   // W/(m² sr); one black texel where there is none.
layout(rgba32f) writeonly uniform image2D result;
#ifdef GIVE_BACK
layout(scalar) readonly buffer Raised { vec3 data[]; } raised;  // By tile (give_back.comp).

vec3 raisedAt(ivec2 pixel, uvec2 pixels) {
    const BlockCorner corners[4] = blockCorners(pixel, float(TILE), tilesOf(pixels));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) sum += corners[i].weight * raised.data[corners[i].block];
    return sum;
}
#endif

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
    if (any(greaterThanEqual(pixel, size))) return;
    const uint element = elementOf(pixel, size, 0);
    const vec4 first = unpackHalves(reflectance.data[element]);
    vec3 sum = first.rgb * unpackValues(irradiance.data[element]).rgb, reflected = first.rgb;
#if SAMPLES > 1
    const uint second = elementOf(pixel, size, 1);
    if (first.a > 0.0) {
        const vec3 secondReflectance = unpackHalves(reflectance.data[second]).rgb;
        if (secondReflectance != vec3(0.0)) sum += secondReflectance * unpackValues(irradiance.data[second]).rgb;
        reflected += secondReflectance;
    }
#endif
#if defined(GIVE_BACK) && defined(SIGNED)
    sum += reflected * raisedAt(pixel, uvec2(size));
#elif defined(GIVE_BACK)
    sum *= raisedAt(pixel, uvec2(size));
#endif
    const vec3 added = texelFetch(unfiltered, min(pixel, textureSize(unfiltered, 0) - 1), 0).rgb;
    imageStore(result, pixel, vec4(sum / 3.14159265358979 + added, 1.0));
}
