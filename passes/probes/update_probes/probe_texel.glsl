// A texel of a probe's octahedral map, and its copies in the border, by which filtering continues over the map's edges.
#ifndef VOXRAY_PROBE_TEXEL_GLSL
#define VOXRAY_PROBE_TEXEL_GLSL

#include "passes/probes/probe_grid.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/octahedral.glsl"

readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer Directions { vec3 data[]; } directions;
layout(scalar) readonly buffer Light { vec4 data[]; } light;  // Of shade_probe_hits.comp.

struct ProbeTexel {
    uint inBatch;  // Index of its probe in the batch.
    ivec2 at;      // Without the border.
    uint stored;   // Index in the histories of all probes.
    ProbePlace place;
    vec3 direction;
};

// Texel i of a batch of probes with maps of `texels` texels along an edge.
ProbeTexel probeTexel(uint i, uint first, uint texels) {
    const uint count = texels * texels, inMap = i % count;
    ProbeTexel t;
    t.inBatch = i / count;
    t.at = ivec2(inMap % texels, inMap / texels);
    const uint probe = list.data[first + t.inBatch];
    t.stored = probe * count + inMap;
    t.place = probePlace(probe);
    t.direction = octahedralDirection((vec2(t.at) + 0.5) / float(texels) * 2.0 - 1.0);
    return t;
}

// A value, not negative, with as many bits as half floats have, up or down at random, so that means are kept. Devices may
// round to zero, which takes up to half a percent of light that is encoded by its fifth root.
float roundedToHalf(float value, uint random) {
    return uintBitsToFloat((floatBitsToUint(value) + (random & 0x1fffu)) & ~0x1fffu);
}

// Stores a texel of a map of n texels along an edge. Across an edge the map continues with that edge turned round.
#define STORE_PROBE_TEXEL(image, t, n, value)                                                                        \
    {                                                                                                                \
        const ivec3 first_ = probeFirstTexel(t.place, uint(n)) + ivec3(1, 1, 0);                                     \
        const ivec2 turned_ = int(n) - 1 - t.at, across_ = ivec2(t.at.x == 0 ? -1 : int(n), t.at.y == 0 ? -1 : int(n)); \
        const bvec2 onEdge_ = bvec2(t.at.x == 0 || turned_.x == 0, t.at.y == 0 || turned_.y == 0);                   \
        imageStore(image, first_ + ivec3(t.at, 0), value);                                                           \
        if (onEdge_.x) imageStore(image, first_ + ivec3(across_.x, turned_.y, 0), value);                            \
        if (onEdge_.y) imageStore(image, first_ + ivec3(turned_.x, across_.y, 0), value);                            \
        if (all(onEdge_)) imageStore(image, first_ + ivec3(int(n) - 1 - across_, 0), value);                         \
    }

#endif
