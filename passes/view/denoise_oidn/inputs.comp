// What Open Image Denoise reads of each pixel: the radiance that its texels reflect, as noisy as their rays, their mean
// albedo and their mean normal.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D irradiance;  // W/m²; number of rays.
uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D albedo;
struct NoisyPixel {
    vec3 radiance;
    vec3 albedo;
    vec3 normal;
};
layout(scalar) writeonly buffer Noisy { NoisyPixel data[]; } noisy;
layout(push_constant) uniform Push {
    uvec2 pixels;
    int samples;
} push;

void main() {
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, push.pixels))) return;
    NoisyPixel sum = NoisyPixel(vec3(0.0), vec3(0.0), vec3(0.0));
    float rays = 0.0, surfaces = 0.0;
    for (int y = 0; y < push.samples; ++y)
        for (int x = 0; x < push.samples; ++x) {
            const ivec2 texel = ivec2(pixel) * push.samples + ivec2(x, y);
            if (texelFetch(position, texel, 0).w == 0.0) continue;
            const vec4 light = texelFetch(irradiance, texel, 0);
            const vec3 reflectance = texelFetch(albedo, texel, 0).rgb;
            sum.radiance += light.w * reflectance * light.rgb;
            sum.albedo += reflectance;
            sum.normal += texelFetch(normal, texel, 0).xyz;
            rays += light.w;
            surfaces += 1.0;
        }
    const float texels = float(push.samples * push.samples), length_ = length(sum.normal);
    sum.radiance *= surfaces / (texels * max(rays, 1.0) * 3.14159265358979);
    sum.albedo /= texels;
    sum.normal /= max(length_, 1e-6);
    noisy.data[pixel.y * push.pixels.x + pixel.x] = sum;
}
