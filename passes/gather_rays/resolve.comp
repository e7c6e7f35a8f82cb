#version 460
#extension GL_EXT_scalar_block_layout : require
// Radiance that each pixel reflects: albedo / pi times irradiance, averaged over its sub-pixels.
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Irradiance { vec4 data[]; } irradiance;
uniform sampler2D albedo;
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant) uniform Push { int samples; } push;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
    if (any(greaterThanEqual(pixel, size))) return;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < push.samples; ++y)
        for (int x = 0; x < push.samples; ++x) {
            const ivec2 texel = pixel * push.samples + ivec2(x, y);
            sum += texelFetch(albedo, texel, 0).rgb * irradiance.data[texel.y * size.x * push.samples + texel.x].rgb;
        }
    imageStore(result, pixel, vec4(sum / (3.14159265358979 * float(push.samples * push.samples)), 1.0));
}
