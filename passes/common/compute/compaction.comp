// Lists the indices of set bits in ascending order.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Flags { uint words[]; } flags;
readonly buffer Before { uint bits[]; } before;  // Set bits in the words before.
writeonly buffer Indices { uint data[]; } indices;
layout(push_constant) uniform Push { uint words; } push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    uint item = before.bits[word];
    for (uint bits = flags.words[word]; bits != 0u; bits &= bits - 1u)
        indices.data[item++] = 32u * word + uint(findLSB(bits));
}
