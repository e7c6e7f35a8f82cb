// Radiance that each pixel of a batch reflects of the ambient light that its rays let through.
#include "batch.glsl"
layout(local_size_x = 64) in;

uniform sampler2D albedo;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
layout(rgba32f) uniform writeonly image2D indirect;

void main() {
    const uint pixel = linearIndex();
    if (pixel >= push.pixels) return;
    const uint perPixel = push.samples * push.samples;
    vec3 sum = vec3(0.0);
    for (uint texel = pixel * perPixel; texel < (pixel + 1u) * perPixel; ++texel) {
        uint open = 0u;
        for (uint i = texel * push.raysPerTexel; i < (texel + 1u) * push.raysPerTexel; ++i)
            if (rays.data[i].tMax >= 0.0 && occluded.data[i] == 0u) ++open;  // An inactive ray is not occluded either.
        // By cosine, albedo / pi times irradiance is albedo times the mean radiance
        sum += texelFetch(albedo, texelOf(texel), 0).rgb * float(open);
    }
    const uint at = push.firstPixel + pixel;
    imageStore(indirect, ivec2(at % push.width, at / push.width),
               vec4(push.ambient * sum / float(perPixel * push.raysPerTexel), 1.0));
}
