// Reservoirs of gather rays, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_RESERVOIR_TYPES_H
#define VOXRAY_SHARED_RESERVOIR_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// The visible point that a gather ray starts from (x_v, n_v of Ouyang et al. 2021).
struct Receiver {
    vec3 origin;      // Of the ray, m: off the surface.
    float distance_;  // To the camera, m; 0: there is no surface.
    uint normal;      // Shading normal, octahedral.
    uint faceNormal;  // Geometric normal, octahedral.
    uint instance;    // Mesh instance plus 1, or 0 where no motion is read.
};

// The sample point that a reservoir has selected (x_s, n_s), and its weight. Densities are by area at the sample point,
// so that a sample keeps its density when another receiver takes it over.
struct Reservoir {
    vec3 position;       // m; on the surface.
    uint normal;         // Geometric normal, on the receivers' side, octahedral.
    vec3 light;          // π times the radiance that the point sends, W/m².
    float nearDistance;  // GatherLight::nearDistances; negative for a sample closer than that to its receiver.
    vec2 barycentrics;   // On its triangle, as Hit has them.
    uint side;           // Index of the triangle, times 2, plus 1 if the receivers are behind it.
    float W;     // Unbiased contribution weight: estimates the reciprocal of the sample's density, m²; 0: none.
    float M;     // Confidence weight: number of rays that were candidates.
    float rays;  // Independent rays to which the estimate's variance corresponds.
};

VOXRAY_SHARED_END

#endif
