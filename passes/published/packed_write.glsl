// How a color is merged into a voxel's word, as published in Magalhães 2020. Host:
// passes/published/magalhaes_2020/packed_voxels.h, which defines PACKED_WRITE.
#ifndef VOXRAY_PACKED_WRITE_GLSL
#define VOXRAY_PACKED_WRITE_GLSL

#include "shaders/compute/large_buffer.glsl"

#define PACKED_MOVING_AVERAGE 0
#define PACKED_MAX 1
#define PACKED_NONE 2

// Merges a color, clamped to [0, 1], into a word.
void writePacked(LargeUints words, uint index, vec3 color) {
#if PACKED_WRITE == PACKED_MOVING_AVERAGE
    // Listing 4.3: compare and swap the mean; the number of colors, in alpha, stops at 255. The loop ends: each failed
    // attempt is another invocation's success.
    uint expected = 0u;
    uint desired = packUnorm4x8(vec4(color, 1.0 / 255.0));
    for (;;) {
        const uint current = atomicCompSwap(words.data[index], expected, desired);
        if (current == expected) return;
        expected = current;
        const vec4 mean = unpackUnorm4x8(current);
        const float count = round(mean.a * 255.0);
        desired = packUnorm4x8(vec4((mean.rgb * count + color) / (count + 1.0), (count + 1.0) / 255.0));
    }
#elif PACKED_WRITE == PACKED_MAX
    // Section 5.2.4: a maximum of packed words, decided by blue, then green, then red
    atomicMax(words.data[index], packUnorm4x8(vec4(color, 1.0)));
#else
    // The last write wins
    words.data[index] = packUnorm4x8(vec4(color, 1.0));
#endif
}

#endif
