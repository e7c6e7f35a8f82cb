// The texel that a camera ray goes through: row by row, or with PIXEL_ORDER pixel by pixel, so that a pixel's rays are
// neighbors.
#ifndef VOXRAY_GBUFFER_SAMPLED_TEXEL_GLSL
#define VOXRAY_GBUFFER_SAMPLED_TEXEL_GLSL

#define TEXELS (SAMPLES * SAMPLES)  // Of a pixel.

ivec2 texelOf(uint pixel, uint t, uint texelsAcross) {
    const uint pixelsAcross = texelsAcross / SAMPLES;
    return ivec2(pixel % pixelsAcross, pixel / pixelsAcross) * SAMPLES + ivec2(t % SAMPLES, t / SAMPLES);
}

ivec2 sampledTexel(uint ray, uint texelsAcross) {
#ifdef PIXEL_ORDER
    return texelOf(ray / TEXELS, ray % TEXELS, texelsAcross);
#else
    return ivec2(ray % texelsAcross, ray / texelsAcross);
#endif
}

#endif
