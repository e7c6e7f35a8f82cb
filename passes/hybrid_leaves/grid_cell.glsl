// What a cell of a leaf's grid holds of the surfaces in it, packed in three words, and in three more where
// surfaces emit light or have specular lobes.
#ifndef VOXRAY_GRID_CELL_GLSL
#define VOXRAY_GRID_CELL_GLSL

#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/scene/octahedral.glsl"
#include "shaders/scene/shared_exponent.glsl"

// Averages are weighted by area.
struct GridCell {
    vec3 normal;      // Unit length: of front-side shading normals.
    float distance_;  // Of the surfaces' mean point from the cell's center, along the normal, in cells.
    vec3 albedo;      // Diffuse reflectance.
    float reach;      // Surfaces lie this far from the plane with that normal and distance, at most; in cells.
};

// Words: the normal; albedo in 11, 11 and 10 bits; distance in 24 bits and reach in the 8 that count most, so that the largest is found
// by atomicMax().
const float CELL_DIAGONALS = 1.75;  // Range of distances, in cells: no less than a diagonal.
const uint DISTANCE_UNITS = 0xffffffu;

void storeGridCell(uint number, GridCell c) {
    const uvec3 albedo = uvec3(round(clamp(c.albedo, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0)));
    const uint distance_ = uint(round(clamp(c.distance_ / CELL_DIAGONALS + 0.5, 0.0, 1.0) * float(DISTANCE_UNITS)));
    const uint reach = uint(round(clamp(c.reach / CELL_DIAGONALS, 0.0, 1.0) * 255.0));
    const uint at = number * hybridLeaves.shape.cellWords;
    hybridLeaves.cells.data[at] = toOctahedral(c.normal);
    hybridLeaves.cells.data[at + 1u] = albedo.x | albedo.y << 11 | albedo.z << 22;
    hybridLeaves.cells.data[at + 2u] = distance_ | reach << 24;
}

// The cell whose first word is `at`.
GridCell gridCellAt(LargeUints cells, uint at) {
    const uint albedo = cells.data[at + 1u], rest = cells.data[at + 2u];
    GridCell c;
    c.normal = fromOctahedral(cells.data[at]);
    c.distance_ = (float(rest & DISTANCE_UNITS) / float(DISTANCE_UNITS) - 0.5) * CELL_DIAGONALS;
    c.albedo = vec3(albedo & 2047u, albedo >> 11 & 2047u, albedo >> 22) / vec3(2047.0, 2047.0, 1023.0);
    c.reach = float(rest >> 24) / 255.0 * CELL_DIAGONALS;
    return c;
}
GridCell gridCell(uint number) { return gridCellAt(hybridLeaves.cells, number * hybridLeaves.shape.cellWords); }

// Lets a cell reach as far as `reach` from its plane: rounded up, and a unit more, since the normal and walks are
// rounded, too.
void widenGridCell(uint number, float reach) {
    const uint at = number * hybridLeaves.shape.cellWords + 2u, units = uint(clamp(ceil(reach / CELL_DIAGONALS * 255.0) + 1.0, 0.0, 255.0));
    atomicMax(hybridLeaves.cells.data[at], units << 24 | (hybridLeaves.cells.data[at] & DISTANCE_UNITS));
}

// What else a cell holds in scenes where surfaces emit light or have specular lobes: averages weighted by area.
struct BrightCell {
    vec3 emission;    // W/(m² sr)
    bool bothSides;   // Back sides emit it, too.
    vec3 f0;          // As in Specular (shaders/scene/specular.glsl).
    float f90;
    float roughness;
};

// Words: emission over the largest of the scene, with a common exponent; F0 in 11, 11 and 10 bits; roughness in 16, F90 in 15 and the sides in 1.
void storeBrightCell(uint number, BrightCell c) {
    const uint at = number * hybridLeaves.shape.cellWords + GRID_CELL_WORDS;
    const uvec3 f0 = uvec3(round(clamp(c.f0, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0)));
    const uvec2 rest = uvec2(round(clamp(vec2(c.roughness, c.f90), 0.0, 1.0) * vec2(65535.0, 32767.0)));
    const float scale = LARGEST_SHARED_EXPONENT / max(hybridLeaves.shape.largestEmission, 1e-20);
    hybridLeaves.cells.data[at] = toSharedExponent(c.emission * scale);
    hybridLeaves.cells.data[at + 1u] = f0.x | f0.y << 11 | f0.z << 22;
    hybridLeaves.cells.data[at + 2u] = rest.x | rest.y << 16 | (c.bothSides ? 1u << 31 : 0u);
}

BrightCell brightCell(uint number) {
    if (hybridLeaves.shape.cellWords == GRID_CELL_WORDS) return BrightCell(vec3(0.0), false, vec3(0.0), 0.0, 1.0);
    const uint at = number * hybridLeaves.shape.cellWords + GRID_CELL_WORDS;
    const uint f0 = hybridLeaves.cells.data[at + 1u], rest = hybridLeaves.cells.data[at + 2u];
    const float scale = hybridLeaves.shape.largestEmission / LARGEST_SHARED_EXPONENT;
    return BrightCell(fromSharedExponent(hybridLeaves.cells.data[at]) * scale, (rest & 1u << 31) != 0u,
                     vec3(f0 & 2047u, f0 >> 11 & 2047u, f0 >> 22) / vec3(2047.0, 2047.0, 1023.0),
                     float(rest >> 16 & 32767u) / 32767.0, float(rest & 65535u) / 65535.0);
}

#endif
