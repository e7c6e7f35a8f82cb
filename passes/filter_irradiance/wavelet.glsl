// What the wavelets over means and over irradiance have in common.
#ifndef VOXRAY_FILTER_WAVELET_GLSL
#define VOXRAY_FILTER_WAVELET_GLSL

#include "passes/filter_irradiance/filter_types.h"
#include "shaders/scene/octahedral.glsl"

// Squared sine of the angle between the line from one texel to the other and the surface at either, the larger one: 0 on a plane
// that both share, 1 straight above it. It has no unit, so that it holds at any scale.
float offPlane(FilterTexel a, FilterTexel b) {
    const vec3 between = b.position - a.position;
    const float squared = dot(between, between);
    if (squared == 0.0) return 0.0;
    const float height = max(abs(dot(fromOctahedral(a.geometricNormal), between)),
                             abs(dot(fromOctahedral(b.geometricNormal), between)));
    return min(height * height / squared, 1.0);
}

// By how much the variance of a level's values is above that of a mean of independent ones. From level 1 on what taps stand for
// overlaps: without edges variance falls by 4.2 a level, not by 7.1.
float overlap(int level) { return level == 0 ? 1.0 : 1.7; }

#endif
