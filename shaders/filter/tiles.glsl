// Tiles of the frame in which light that a filter lost is given back.
#ifndef VOXRAY_FILTER_TILES_GLSL
#define VOXRAY_FILTER_TILES_GLSL

#define TILE 16  // Pixels along an edge.

// Sums over a tile's elements, by their area, W/m² times pixels.
struct TileLight {
    vec3 kept;  // With SIGNED the area, pixels.
    vec3 excess;
};

uvec2 tilesOf(uvec2 pixels) { return (pixels + uint(TILE - 1)) / uint(TILE); }

#endif
