// Layout of the sums over a grid cell's surfaces, in uints; shared by C++ and GLSL.
#ifndef VOXRAY_CELL_SUMS_H
#define VOXRAY_CELL_SUMS_H

// Area; then signed sums weighted by area.
#define SUM_AREA 0u
#define SUM_NORMAL 1u
#define SUM_POINT 4u  // Centroid from the cell's center, in cells.
#define SUM_ALBEDO 7u
#define SUM_UINTS 10u
// Where surfaces emit light or have specular lobes (EXTENDED_CELL_WORDS):
#define SUM_EMISSION 10u             // Relative to the scene's largest.
#define SUM_EMISSION_BOTH_SIDES 13u  // Of double-sided surfaces: largest channel.
#define SUM_F0 14u
#define SUM_F90 17u
#define SUM_ROUGHNESS 18u
#define EXTENDED_SUM_UINTS 19u

#endif
