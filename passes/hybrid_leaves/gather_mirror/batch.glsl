// A batch of pixels and its slots; how specular light is divided up between rays and cones.
#ifndef VOXRAY_MIRROR_BATCH_GLSL
#define VOXRAY_MIRROR_BATCH_GLSL

#include "passes/hybrid_leaves/gather_mirror/mirror_types.h"
#include "shaders/compute/linear_index.glsl"

uint texelsPerPixel(MirrorBatch b) { return b.samples * b.samples; }

// The place in the g-buffer of a texel, by its number in the batch.
ivec2 texelOf(MirrorBatch b, uint number) {
    const uint within = number % texelsPerPixel(b), pixel = b.firstPixel + number / texelsPerPixel(b);
    return ivec2(uvec2(pixel % b.width, pixel / b.width) * b.samples + uvec2(within % b.samples, within / b.samples));
}

// The part of a lobe that rays bring; cones bring the rest, so that both together are the lobe at every roughness.
float rayWeight(MirrorBatch b, float roughness) {
    if (roughness <= b.maxRoughness) return 1.0;
    return max(1.0 - (roughness - b.maxRoughness) / max(b.blendRoughness, 1e-6), 0.0);
}

#endif
