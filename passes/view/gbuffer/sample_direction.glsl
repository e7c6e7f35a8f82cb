// The camera ray of each of a pixel's samples.
#ifndef VOXRAY_GBUFFER_SAMPLE_DIRECTION_GLSL
#define VOXRAY_GBUFFER_SAMPLE_DIRECTION_GLSL

#include "passes/view/camera_view.glsl"
#include "shaders/scene/sampling.glsl"

// Beside other random numbers of the frame; the second one for the second coordinate.
#define POINT_SEED 0x70697865u
#define SECOND_POINT_SEED 0x63d83595u

// samples: texels along an edge of a pixel. seed: of the frame.
vec3 sampleDirection(CameraView view, uvec2 texel, uint samples, uint seed) {
#if defined(RANDOM_POINTS)
    const uint bits = hashCombine(hashCombine(seed ^ POINT_SEED, texel.x), texel.y);
    return viewDirectionAt(view, vec2(texel) + vec2(toUnit(bits), toUnit(hash(bits ^ SECOND_POINT_SEED))));
#elif defined(ROTATED_GRID)
    // No two samples of a pixel in one column or row, so that an edge along either covers it in steps of one sample;
    // with samples = 2 the standard positions of multisampling with four
    const uvec2 inPixel = texel % samples;
    const vec2 inTexel = (vec2(samples - 1u - inPixel.y, inPixel.x) + 0.5) / float(samples);
    return viewDirectionAt(view, vec2(texel) + inTexel);
#else
    return viewDirection(view, texel);
#endif
}

#endif
