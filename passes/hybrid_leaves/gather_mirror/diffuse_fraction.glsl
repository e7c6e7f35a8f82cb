// What a dielectric layer leaves to the diffuse lobe below it.
#ifndef VOXRAY_MIRROR_DIFFUSE_FRACTION_GLSL
#define VOXRAY_MIRROR_DIFFUSE_FRACTION_GLSL


#include "passes/hybrid_leaves/gather_mirror/mirror_types.h"
#include "shaders/scene/specular.glsl"

layout(scalar) readonly buffer Grazing { float data[]; } grazing;  // grazing_table.h

// Of light that arrives alike from everywhere, seen at a cosine to the normal.
float meanDiffuseFraction(Specular s, float cosOut) {
    if (!hasSpecular(s) || s.dielectricF90 == 0.0) return 1.0;
    const float at = sqrt(clamp(cosOut, 0.0, 1.0)) * float(GRAZING_COSINES - 1);
    const uint first = min(uint(at), uint(GRAZING_COSINES - 2));
    return diffuseFraction(s, mix(grazing.data[first], grazing.data[first + 1u], at - float(first)));
}

#endif
