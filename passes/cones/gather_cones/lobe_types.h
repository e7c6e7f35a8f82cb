// Table of specular lobes, shared by C++ and GLSL: strata for each cosine to the viewer and each roughness.
#ifndef VOXRAY_LOBE_TYPES_H
#define VOXRAY_LOBE_TYPES_H

#include "shaders/shared/types.h"

// Square roots of the cosine to the viewer, and roughnesses: both evenly spaced from 0 to 1.
#define LOBE_COSINES 64
#define LOBE_ROUGHNESSES 32
#define LOBES (LOBE_COSINES * LOBE_ROUGHNESSES)

VOXRAY_SHARED_BEGIN

// A stratum of a lobe, which one cone represents.
struct LobeStratum {
    vec3 mean;      // Of the incident directions: along the surface away from the viewer, across that, along
                    // the normal.
    vec2 albedo;    // Fraction of uniform incident radiance that it reflects, by F0 and by F90.
    float grazing;  // Mean of Schlick's weight over a Lambert lobe below, the same in all strata.
};

VOXRAY_SHARED_END

#endif
