// Links that wait for their rays, by surfel and ray (host: passes/radiosity/link_surfels/waiting_links.h).
#ifndef VOXRAY_WAITING_LINKS_GLSL
#define VOXRAY_WAITING_LINKS_GLSL

#include "shaders/compute/large_buffer.glsl"

layout(scalar) readonly buffer WaitingRef { LargeUints waiting; };

// Classes of surfels whose links are traced in turns.
#define LINK_GROUPS 64u  // kGroups of waiting_links.cpp.

uint linkGroup(uint surfel) { return surfel % LINK_GROUPS; }

// The next bit that is set, which is cleared.
uint takeBit(inout uint bits) {
    const uint bit = uint(findLSB(bits));
    bits &= bits - 1u;
    return bit;
}

#endif
