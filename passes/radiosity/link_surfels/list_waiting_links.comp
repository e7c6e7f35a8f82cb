// Lists the waiting links of the selected classes, with their rays.
#include "passes/radiosity/link_surfels/waiting_links.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
readonly buffer Selected { uint words[]; } selected;  // By group of surfels and ray.
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
writeonly buffer ListedRays { uint data[]; } listedRays;
buffer ListedCount { uint value; } listedCount;
layout(push_constant) uniform Push {
    uint count;
    uint firstSurfel;
    uint raysPerSurfel;
    uint wordsPerSurfel;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint surfel = push.firstSurfel + i;
    for (uint word = 0u; word < push.wordsPerSurfel; ++word) {
        const uint at = surfel * push.wordsPerSurfel + word, bits = waiting.data[at];
        uint taken = bits & selected.words[linkGroup(surfel) * push.wordsPerSurfel + word];
        if (taken == 0u) continue;
        waiting.data[at] = bits & ~taken;
        const Surfel s = surfels.data[i];
        const uint seed = hashCombine(push.seed, s.id);
        while (taken != 0u) {
            const uint ray = 32u * word + takeBit(taken), listed = atomicAdd(listedCount.value, 1u);
            rays.data[listed] = Ray(s.position, 0.0, cosineDirection(sobol2(ray, seed), s.normal), 1.0e30);
            listedRays.data[listed] = surfel * push.raysPerSurfel + ray;
        }
    }
}
