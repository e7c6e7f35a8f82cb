// A batch of pixels; the blend between rays and cones.
#ifndef VOXRAY_MIRROR_BATCH_GLSL
#define VOXRAY_MIRROR_BATCH_GLSL

#include "passes/hybrid_leaves/gather_mirror/mirror_types.h"
#include "shaders/compute/linear_index.glsl"

uint texelsPerPixel(MirrorBatch b) { return b.samples * b.samples; }

// Texel of the G-buffer by its index in the batch.
ivec2 texelOf(MirrorBatch b, uint texelIndex) {
    const uint texelInPixel = texelIndex % texelsPerPixel(b), pixel = b.firstPixel + texelIndex / texelsPerPixel(b);
    return ivec2(uvec2(pixel % b.width, pixel / b.width) * b.samples +
                 uvec2(texelInPixel % b.samples, texelInPixel / b.samples));
}

// Weight of rays for a specular lobe; cones have the rest, so that the sum is the lobe at every roughness.
float rayWeight(MirrorBatch b, float roughness) {
    if (roughness <= b.maxRoughness) return 1.0;
    return max(1.0 - (roughness - b.maxRoughness) / max(b.blendRoughness, 1e-6), 0.0);
}

#endif
