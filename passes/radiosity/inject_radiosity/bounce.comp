// One bounce: each surfel receives the mean of what its links send, and reflects it. Links are distributed by cosine, so that
// irradiance is the mean of radiosity over them; a link to nothing counts as dark.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer LinksAt { LargeUints links; };
layout(scalar) readonly buffer SentAt { LargeUints sent; };            // Of all surfels, packed.
layout(scalar) readonly buffer ReflectedAt { LargeUints reflected; };
layout(scalar) buffer Indirect { vec4 data[]; } indirect;         // W/m², the sum of all bounces.
layout(push_constant) uniform Push {
    uint count;
    uint firstNumber;
    uint rays;  // Whose links are read, of each surfel.
    uint surfelCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint number = push.firstNumber + i;
    vec3 sum = vec3(0.0);
    for (uint ray = 0u; ray < push.rays; ++ray) {
        const uint other = links.data[ray * push.surfelCount + number];
        if (other != 0xffffffffu) sum += unpackRadiosity(sent.data[other]);
    }
    const vec3 irradiance = sum / float(push.rays);
    indirect.data[i] += vec4(irradiance, 0.0);
    reflected.data[number] = packRadiosity(surfels.data[i].reflectance * irradiance);
}
