// Sets a bit for each ray that hit.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
writeonly buffer Flags { uint words[]; } flags;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint word = linearIndex(), first = 32u * word;
    if (first >= push.count) return;
    uint bits = 0u;
    for (uint i = first; i < min(first + 32u, push.count); ++i)
        if (hits.data[i].triangle != NO_HIT) bits |= 1u << (i - first);
    flags.words[word] = bits;
}
