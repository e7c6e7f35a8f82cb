// Grids of irradiance probes, shared by C++ (passes/probes/probes.h) and GLSL.
#ifndef VOXRAY_SHARED_PROBE_TYPES_H
#define VOXRAY_SHARED_PROBE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// What all cascades have in common, and how they are looked up (parameters of update_probes).
struct ProbeSettings {
    uvec3 counts;           // Probes of a cascade along each axis.
    uint cascades;          // From the finest to the coarsest.
    uint irradianceTexels;  // Along an edge of a probe's octahedral map, without its border.
    uint depthTexels;
    uint testsVisibility;  // 1: Chebyshev's weights.
    uint wrapsWeights;     // 1: probes behind the surface have a weight, too.
    float normalBias;      // Of the smallest spacing.
    float viewBias;        // Of the smallest spacing.
    float crushThreshold;
    float encodingGamma;
    float blendGamma;
    float unit;  // Irradiance of the value 1, W/m².
};

// A cascade: probes on the lattice of points origin + spacing k. It holds the points k from `first` on, `counts` of
// them along each axis, each at the place k modulo `counts` of the storage: where the cascade moves, probes that it
// keeps stay where they are.
struct ProbeGrid {
    vec3 origin;
    vec3 spacing;  // m
    ivec3 first;
    float minSpacing;  // m: the smallest component of `spacing`, to which biases and distances are relative.
};

struct ProbeState {
    vec3 offset;  // From the point of the lattice, m.
    uint status;
};

#define PROBE_ON 0u
#define PROBE_IN_SURFACES 1u  // Too many of its rays hit surfaces from behind.
#define PROBE_IN_SPACE 2u     // No surface is near enough to be lit from it.

VOXRAY_SHARED_END

#endif
