// What is summed of the surfaces in each cell of a grid, in uints: shared by C++ and GLSL.
#ifndef VOXRAY_CELL_SUMS_H
#define VOXRAY_CELL_SUMS_H

// Area; then, weighted by it, what follows, signed.
#define SUM_AREA 0u
#define SUM_NORMAL 1u
#define SUM_POINT 4u  // Centroids, from the cell's center, in cells.
#define SUM_PROJECTED \
    7u  // Components of the geometric normal, without their signs: area as seen along each axis.
#define SUM_ALBEDO 10u
#define SUM_METALLIC 13u
#define SUM_ROUGHNESS 14u
#define SUM_UINTS 15u

#endif
