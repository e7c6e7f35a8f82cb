// The table of specular lobes, shared by C++ and GLSL: for each cosine to the viewer and each roughness the
// lobe's strata.
#ifndef VOXRAY_LOBE_TYPES_H
#define VOXRAY_LOBE_TYPES_H

#include "shaders/shared/types.h"

// Roots of the cosine to the viewer, and roughnesses: both evenly spaced from 0 to 1.
#define LOBE_COSINES 64
#define LOBE_ROUGHNESSES 32
#define LOBES (LOBE_COSINES * LOBE_ROUGHNESSES)

VOXRAY_SHARED_BEGIN

// A part of a lobe: what of it one cone stands for.
struct LobeStratum {
    vec3 mean;    // Of the directions that it reflects from: along the surface away from the viewer, across
                  // that, along the normal.
    vec2 albedo;  // Part of an even surrounding that it reflects, by F0 and by F90.
    float
        grazing;  // Mean of Schlick's weight over what a Lambert lobe below reflects, the same in all strata.
};

VOXRAY_SHARED_END

#endif
