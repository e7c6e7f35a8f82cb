// One bounce by gathering: each surfel takes the mean radiosity of the surfels that it is linked to, and reflects it.
// Links are cosine-distributed, so that irradiance is that mean; a link without surfel counts as black, and one that has not been traced does not count.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer LinksRef { LargeUints links; };
layout(scalar) readonly buffer PreviousRadiosityRef { LargeUints previousRadiosity; };  // Of all surfels, packed.
layout(scalar) readonly buffer NextRadiosityRef { LargeUints nextRadiosity; };
layout(scalar) buffer Indirect { vec4 data[]; } indirect;  // W/m², sum over bounces.
layout(push_constant) uniform Push {
    uint count;
    uint firstSurfel;
    uint rays;  // Links per surfel that are read.
    uint surfelCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint surfel = push.firstSurfel + i;
    vec3 sum = vec3(0.0);
    uint known = 0u;
    for (uint ray = 0u; ray < push.rays; ++ray) {
        const uint linked = links.data[ray * push.surfelCount + surfel];
        if (linked < LINK_NOT_TRACED) sum += unpackRadiosity(previousRadiosity.data[linked]);
        known += linked != LINK_NOT_TRACED ? 1u : 0u;
    }
    const vec3 irradiance = sum / float(max(known, 1u));
    indirect.data[i] += vec4(irradiance, 0.0);
    nextRadiosity.data[surfel] = packRadiosity(surfels.data[i].reflectance * irradiance);
}
