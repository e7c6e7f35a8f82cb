// final = emission + ambient * albedo + direct + indirect. Images that no pass writes are bound as one black texel.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D emission;
uniform sampler2D albedo;
uniform sampler2D direct;
uniform sampler2D indirect;
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant, scalar) uniform Push {
    int samples;    // Texels of the G-buffer along an edge of a pixel.
    float ambient;  // W/(m² sr)
} push;

vec3 texel(sampler2D image, ivec2 pixel) { return texelFetch(image, min(pixel, textureSize(image, 0) - 1), 0).rgb; }

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    vec3 emitted = vec3(0.0);
    for (int j = 0; j < push.samples; ++j)
        for (int i = 0; i < push.samples; ++i) {
            const ivec2 sample_ = pixel * push.samples + ivec2(i, j);
            emitted += texelFetch(emission, sample_, 0).rgb;
            if (push.ambient > 0.0) emitted += push.ambient * texelFetch(albedo, sample_, 0).rgb;
        }
    emitted /= float(push.samples * push.samples);
    imageStore(result, pixel, vec4(emitted + texel(direct, pixel) + texel(indirect, pixel), 1.0));
}
