// What compare_cones records of each cone, shared by C++ and GLSL.
#ifndef VOXRAY_CONE_RECORD_H
#define VOXRAY_CONE_RECORD_H

// Levels of voxels; coarser ones count as the last.
#define RECORDED_LEVELS 8

// Indices of a record's numbers. Light is the luminance that the pixel reflects of the cone's light, W/(m² sr).
#define RAY_NEAR 0   // Along the exact ray, from hits near the start, read in the finest voxels.
#define RAY_FAR 1    // From hits beyond.
#define RAY_CONE 2   // From all hits, read in voxels as wide as the cone there.
#define RAY_LEVEL 3  // The same, read in voxels of each level.
#define CONE_START (RAY_LEVEL + RECORDED_LEVELS)       // Taken by the cone near its start, away from the ray's hit.
#define CONE_BEFORE (CONE_START + 1)                   // Before the ray's hit.
#define CONE_AT_HIT (CONE_START + 2)                   // Around it.
#define CONE_BEHIND (CONE_START + 3)                   // Behind it.
#define CONE_MISSED (CONE_START + 4)                   // Where the ray hits nothing.
#define CONE_LEVEL (CONE_START + 5)                    // By level.
#define OPACITY_BEFORE (CONE_LEVEL + RECORDED_LEVELS)  // Weight of what is occluded before the ray's hit.
#define OPACITY_BEHIND (OPACITY_BEFORE + 1)            // Of what is not, right behind it.
#define WEIGHT_OF_HITS (OPACITY_BEFORE + 2)            // Of all rays that hit.
#define RECORDED_NUMBERS (OPACITY_BEFORE + 3)

#endif
