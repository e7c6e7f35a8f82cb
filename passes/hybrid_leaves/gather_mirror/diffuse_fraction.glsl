// The fraction of light that a dielectric layer transmits to the diffuse lobe below it.
#ifndef VOXRAY_MIRROR_DIFFUSE_FRACTION_GLSL
#define VOXRAY_MIRROR_DIFFUSE_FRACTION_GLSL

#include "passes/hybrid_leaves/gather_mirror/mirror_types.h"
#include "shaders/scene/specular.glsl"

layout(scalar) readonly buffer SchlickMeans { float data[]; } schlickMeans;  // schlick_table.h

// For uniform incident light and a viewer at that cosine to the normal.
float meanDiffuseFraction(Specular s, float cosOut) {
    if (!hasSpecular(s) || s.dielectricF90 == 0.0) return 1.0;
    const float entry = sqrt(clamp(cosOut, 0.0, 1.0)) * float(SCHLICK_TABLE_SIZE - 1);
    const uint first = min(uint(entry), uint(SCHLICK_TABLE_SIZE - 2));
    return diffuseFraction(s, mix(schlickMeans.data[first], schlickMeans.data[first + 1u], entry - float(first)));
}

#endif
