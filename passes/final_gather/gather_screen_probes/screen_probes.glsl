// Which probes are near a texel, and which of them are on its surface.
#ifndef VOXRAY_SCREEN_PROBES_GLSL
#define VOXRAY_SCREEN_PROBES_GLSL

#include "passes/final_gather/gather_screen_probes/screen_probe_types.h"
#include "shaders/scene/octahedral.glsl"

// Surfaces that share light: probes farther than a quarter of a tile off each other's planes, or with normals more than
// 26° apart, have nothing of each other (the angle is that of `accumulate`).
#define MAX_PLANE_DISTANCE 0.25  // Widths of a tile.
#define MIN_COSINE 0.9

ivec2 unpackTexel(uint texel) { return ivec2(texel & 0xffffu, texel >> 16); }

// 1 for a point on the probe's plane with its normal, 0 for one on another surface. `width`: of a tile, m.
float surfaceWeight(vec3 point, vec3 faceNormal, ScreenProbe probe, float width) {
    const vec3 segment = probe.position - point, other = fromOctahedral(probe.faceNormal);
    const float off = max(abs(dot(segment, faceNormal)), abs(dot(segment, other))) / (MAX_PLANE_DISTANCE * width);
    const float plane = max(1.0 - off * off, 0.0);
    return plane * clamp((dot(faceNormal, other) - MIN_COSINE) / (1.0 - MIN_COSINE), 0.0, 1.0);
}

// The same of two probes, which of them is first does not matter.
float sharedSurface(ScreenProbe a, ScreenProbe b) {
    return surfaceWeight(a.position, fromOctahedral(a.faceNormal), b, min(a.width, b.width));
}

// A tent of one tile's width to each side: between probes on a regular grid it interpolates bilinearly.
float screenWeight(vec2 offsetTexels, float edge) {
    const vec2 tent = max(1.0 - abs(offsetTexels) / edge, 0.0);
    return tent.x * tent.y;
}

// The tent of the filter over probes, of twice that width.
float neighborWeight(ScreenProbe probe, uint otherTexel, uint edge) {
    return screenWeight(vec2(unpackTexel(otherTexel) - unpackTexel(probe.texel)), 2.0 * float(edge));
}

// The 3 x 3 tiles around one, clipped at the image's border.
void tilesAround(ProbeTiles t, ivec2 tile, out ivec2 first, out ivec2 last) {
    first = max(tile - 1, ivec2(0));
    last = min(tile + 1, ivec2(t.tiles) - 1);
}

#endif
