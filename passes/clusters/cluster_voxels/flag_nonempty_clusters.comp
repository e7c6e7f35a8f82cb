// Sets a bit for each cluster that has voxels.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer MemberCounts { uint data[]; } memberCounts;
writeonly buffer Flags { uint words[]; } flags;
layout(push_constant) uniform Push { uint numbers; } push;

void main() {
    const uint word = linearIndex();
    if (32u * word >= push.numbers) return;
    uint bits = 0u;
    for (uint i = 0u; i < 32u && 32u * word + i < push.numbers; ++i)
        if (memberCounts.data[32u * word + i] != 0u) bits |= 1u << i;
    flags.words[word] = bits;
}
