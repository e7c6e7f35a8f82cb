// How colors that meet in a voxel are merged in its word, as published in Magalhães 2020. Host:
// passes/published/magalhaes_2020/packed_voxels.h, which defines PACKED_WRITE.
#ifndef VOXRAY_PACKED_WRITE_GLSL
#define VOXRAY_PACKED_WRITE_GLSL

#include "shaders/compute/large_buffer.glsl"

#define PACKED_MOVING_AVERAGE 0
#define PACKED_MAX 1
#define PACKED_NONE 2

// Merges a color, of which 0 to 1 is stored, into a word.
void writePacked(LargeUints words, uint at, vec3 color) {
#if PACKED_WRITE == PACKED_MOVING_AVERAGE
    // Listing 4.3: swap the mean in unless another thread came between; the number of colors in alpha stops at 255. Each failed
    // attempt is another thread's success, so that the loop ends.
    uint expected = 0u;
    uint desired = packUnorm4x8(vec4(color, 1.0 / 255.0));
    for (;;) {
        const uint found = atomicCompSwap(words.data[at], expected, desired);
        if (found == expected) return;
        expected = found;
        const vec4 mean = unpackUnorm4x8(found);
        const float count = round(mean.a * 255.0);
        desired = packUnorm4x8(vec4((mean.rgb * count + color) / (count + 1.0), (count + 1.0) / 255.0));
    }
#elif PACKED_WRITE == PACKED_MAX
    // Section 5.2.4, of the packed word: blue decides, then green, then red.
    atomicMax(words.data[at], packUnorm4x8(vec4(color, 1.0)));
#else
    // The last one stays.
    words.data[at] = packUnorm4x8(vec4(color, 1.0));
#endif
}

#endif
