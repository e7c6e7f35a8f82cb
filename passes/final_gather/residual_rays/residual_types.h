// Structs of residual rays, shared by C++ and GLSL.
#ifndef VOXRAY_RESIDUAL_TYPES_H
#define VOXRAY_RESIDUAL_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// How rays are chosen.
struct ResidualChoice {
    float probability;  // That a ray goes on, on the mean.
    float pilots;       // Part of the rays that always go on, and tell the others' probabilities; 0: there are none.
    uint round_;        // ROUND_PILOTS, then ROUND_OTHERS.
    uint tileBlocks;    // Blocks along a tile's edge.
    uvec2 tiles;
};

// Of a tile of blocks of gather rays.
struct ResidualTile {
    float squares;      // Sum of the squared luminance of the pilots' residuals, (W/m²)².
    float rays;         // Rays from surfaces.
    float probability;  // That a ray goes on that is no pilot.
};

VOXRAY_SHARED_END

#define ROUND_PILOTS 0u
#define ROUND_OTHERS 1u

#endif
