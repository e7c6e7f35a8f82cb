// The texel that a camera ray goes through. Rays go pixel by pixel, and row by row of pixels: those that are traced together
// are then next to each other along rows and columns.
#ifndef VOXRAY_GBUFFER_SAMPLED_TEXEL_GLSL
#define VOXRAY_GBUFFER_SAMPLED_TEXEL_GLSL

#define TEXELS (SAMPLES * SAMPLES)  // Of a pixel.

ivec2 texelOf(uint pixel, uint t, uint texelsAcross) {
    const uint pixelsAcross = texelsAcross / SAMPLES;
    return ivec2(pixel % pixelsAcross, pixel / pixelsAcross) * SAMPLES + ivec2(t % SAMPLES, t / SAMPLES);
}

ivec2 sampledTexel(uint ray, uint texelsAcross) { return texelOf(ray / TEXELS, ray % TEXELS, texelsAcross); }

#endif
