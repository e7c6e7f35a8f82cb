// Reflected radiance of each pixel: albedo / pi times irradiance, averaged over its texels.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;
uniform sampler2D albedo;
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant) uniform Push { int samples; } push;

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < push.samples; ++y)
        for (int x = 0; x < push.samples; ++x) {
            const ivec2 texel = pixel * push.samples + ivec2(x, y);
            sum += texelFetch(albedo, texel, 0).rgb * texelFetch(irradiance, texel, 0).rgb;
        }
    imageStore(result, pixel, vec4(sum / (3.14159265358979 * float(push.samples * push.samples)), 1.0));
}
