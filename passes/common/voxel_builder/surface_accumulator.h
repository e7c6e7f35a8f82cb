// Layout of the sums over the surfaces in a voxel, in uints; shared by C++ and GLSL.
#ifndef VOXRAY_SURFACE_ACCUMULATOR_H
#define VOXRAY_SURFACE_ACCUMULATOR_H

// Fixed point with 20 fractional bits: an area of 10^-6 voxel faces still counts, and MAX_FACES fit in a signed
// sum.
#define UNITS_PER_FACE 1048576.0
#define MAX_FACES 2047u

// Area; then sums weighted by area.
#define SUM_AREA 0u
#define SUM_AXIS_AREA 1u  // Squared components of the geometric normal.
#define SUM_NORMAL 4u     // Shading normal, signed.
#define SUM_ALBEDO 7u
#define SUM_EMISSION 10u  // Relative to the scene's largest.
#define SUM_METALLIC 13u
#define SUM_ROUGHNESS 14u
// Not sums: masks of the 4x4 sub-samples that surfaces cover, by axis.
#define SUB_SAMPLES 15u
#define ACCUMULATOR_UINTS 18u

#endif
