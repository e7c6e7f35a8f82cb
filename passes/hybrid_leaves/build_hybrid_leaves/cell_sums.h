// What is summed of the surfaces in each cell of a grid, in uints: shared by C++ and GLSL.
#ifndef VOXRAY_CELL_SUMS_H
#define VOXRAY_CELL_SUMS_H

// Area; then, weighted by it, what follows, signed.
#define SUM_AREA 0u
#define SUM_NORMAL 1u
#define SUM_POINT 4u  // Centroids, from the cell's center, in cells.
#define SUM_ALBEDO 7u
#define SUM_UINTS 10u
// In scenes where surfaces emit light or have specular lobes (BRIGHT_CELL_WORDS):
#define SUM_EMISSION 10u    // Relative to the scene's largest.
#define SUM_BOTH_SIDES 13u  // Of its largest channel, what back sides emit, too.
#define SUM_F0 14u
#define SUM_F90 17u
#define SUM_ROUGHNESS 18u
#define BRIGHT_SUM_UINTS 19u

#endif
