// What is summed of the surfaces in each cell of a grid, in uints: shared by C++ and GLSL.
#ifndef VOXRAY_CELL_SUMS_H
#define VOXRAY_CELL_SUMS_H

// Area; then, weighted by it, what follows, signed.
#define SUM_AREA 0u
#define SUM_NORMAL 1u
#define SUM_POINT 4u  // Centroids, from the cell's center, in cells.
#define SUM_ALBEDO 7u
#define SUM_UINTS 10u

#endif
