// Each word takes colors from `threads` threads, of each the same two colors one after the other.
#include "passes/published/packed_write.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer WordsRef { LargeUints words; };
layout(push_constant, scalar) uniform Push {
    uint wordCount;
    uint threads;
    uint firstSamples;
    uint secondSamples;
    vec3 first;
    vec3 second;
} push;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.wordCount * push.threads) return;
    for (uint k = 0u; k < push.firstSamples + push.secondSamples; ++k)
        writePacked(words, i / push.threads, k < push.firstSamples ? push.first : push.second);
}
