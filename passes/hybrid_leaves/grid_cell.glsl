// A cell of a leaf's grid, packed in three words, and in six where surfaces emit light or have specular lobes.
#ifndef VOXRAY_GRID_CELL_GLSL
#define VOXRAY_GRID_CELL_GLSL

#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/scene/octahedral.glsl"
#include "shaders/scene/shared_exponent.glsl"

// Means over the cell's surfaces by area, and the slab that encloses them.
struct GridCell {
    vec3 normal;          // Unit length, of front-side shading normals: the slab's.
    float distance_;  // Of the mean point from the cell's center along the normal, in cells: the slab's middle plane.
    vec3 albedo;          // Diffuse reflectance.
    float halfThickness;  // Maximum distance of surfaces from that plane, in cells.
};

// Words: normal; albedo in 11, 11 and 10 bits; distance in the low 24 bits and half thickness in the high 8, so that
// atomicMax() finds the largest.
const float CELL_DIAGONALS = 1.75;  // Range of distances, in cells: at least a diagonal.
const uint DISTANCE_UNITS = 0xffffffu;

void storeGridCell(uint cellIndex, GridCell c) {
    const uvec3 albedo = uvec3(round(clamp(c.albedo, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0)));
    const uint distance_ = uint(round(clamp(c.distance_ / CELL_DIAGONALS + 0.5, 0.0, 1.0) * float(DISTANCE_UNITS)));
    const uint halfThickness = uint(round(clamp(c.halfThickness / CELL_DIAGONALS, 0.0, 1.0) * 255.0));
    const uint word = cellIndex * hybridLeaves.shape.cellWords;
    hybridLeaves.cells.data[word] = toOctahedral(c.normal);
    hybridLeaves.cells.data[word + 1u] = albedo.x | albedo.y << 11 | albedo.z << 22;
    hybridLeaves.cells.data[word + 2u] = distance_ | halfThickness << 24;
}

// The cell whose first word has the index `word`.
GridCell gridCellAt(LargeUints cells, uint word) {
    const uint albedo = cells.data[word + 1u], packed_ = cells.data[word + 2u];
    GridCell c;
    c.normal = fromOctahedral(cells.data[word]);
    c.distance_ = (float(packed_ & DISTANCE_UNITS) / float(DISTANCE_UNITS) - 0.5) * CELL_DIAGONALS;
    c.albedo = vec3(albedo & 2047u, albedo >> 11 & 2047u, albedo >> 22) / vec3(2047.0, 2047.0, 1023.0);
    c.halfThickness = float(packed_ >> 24) / 255.0 * CELL_DIAGONALS;
    return c;
}
GridCell gridCell(uint cellIndex) { return gridCellAt(hybridLeaves.cells, cellIndex * hybridLeaves.shape.cellWords); }

// Makes a cell at least that thick: rounded up, and one unit more for the rounding of normals and rays.
void thickenGridCell(uint cellIndex, float halfThickness) {
    const uint word = cellIndex * hybridLeaves.shape.cellWords + 2u;
    const uint units = uint(clamp(ceil(halfThickness / CELL_DIAGONALS * 255.0) + 1.0, 0.0, 255.0));
    atomicMax(hybridLeaves.cells.data[word], units << 24 | (hybridLeaves.cells.data[word] & DISTANCE_UNITS));
}

// Means over the cell's surfaces by area, of emission and specular lobes.
struct ExtendedCell {
    vec3 emission;    // W/(m² sr)
    bool emitsBothSides;
    vec3 f0;          // As in Specular (shaders/scene/specular.glsl).
    float f90;
    float roughness;
};

// Words: emission over the scene's largest, with a shared exponent; F0 in 11, 11 and 10 bits; roughness in 16, F90 in
// 15, emitsBothSides in 1.
void storeExtendedCell(uint cellIndex, ExtendedCell c) {
    const uint word = cellIndex * hybridLeaves.shape.cellWords + GRID_CELL_WORDS;
    const uvec3 f0 = uvec3(round(clamp(c.f0, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0)));
    const uvec2 packed_ = uvec2(round(clamp(vec2(c.roughness, c.f90), 0.0, 1.0) * vec2(65535.0, 32767.0)));
    const float scale = LARGEST_SHARED_EXPONENT / max(hybridLeaves.shape.largestEmission, 1e-20);
    hybridLeaves.cells.data[word] = toSharedExponent(c.emission * scale);
    hybridLeaves.cells.data[word + 1u] = f0.x | f0.y << 11 | f0.z << 22;
    hybridLeaves.cells.data[word + 2u] = packed_.x | packed_.y << 16 | (c.emitsBothSides ? 1u << 31 : 0u);
}

ExtendedCell extendedCell(uint cellIndex) {
    if (hybridLeaves.shape.cellWords == GRID_CELL_WORDS) return ExtendedCell(vec3(0.0), false, vec3(0.0), 0.0, 1.0);
    const uint word = cellIndex * hybridLeaves.shape.cellWords + GRID_CELL_WORDS;
    const uint f0 = hybridLeaves.cells.data[word + 1u], packed_ = hybridLeaves.cells.data[word + 2u];
    const float scale = hybridLeaves.shape.largestEmission / LARGEST_SHARED_EXPONENT;
    return ExtendedCell(fromSharedExponent(hybridLeaves.cells.data[word]) * scale, (packed_ & 1u << 31) != 0u,
                        vec3(f0 & 2047u, f0 >> 11 & 2047u, f0 >> 22) / vec3(2047.0, 2047.0, 1023.0),
                        float(packed_ >> 16 & 32767u) / 32767.0, float(packed_ & 65535u) / 65535.0);
}

#endif
