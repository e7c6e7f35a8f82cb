// Radiance that each pixel of a batch reflects of the ambient light along its unoccluded rays.
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
        uint unoccluded = 0u;
        for (uint i = texel * push.raysPerTexel; i < (texel + 1u) * push.raysPerTexel; ++i)
            // An inactive ray is not occluded either
            if (rays.data[i].tMax >= 0.0 && occluded.data[i] == 0u) ++unoccluded;
        // By cosine, albedo / pi times irradiance is albedo times the mean radiance
        sum += texelFetch(albedo, texelOf(texel), 0).rgb * float(unoccluded);
    }
    const uint index = push.firstPixel + pixel;
    imageStore(indirect, ivec2(index % push.width, index / push.width),
               vec4(push.ambient * sum / float(perPixel * push.raysPerTexel), 1.0));
}
