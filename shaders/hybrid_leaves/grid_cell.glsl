// What a cell of a leaf's grid holds of the surfaces in it, packed in three words.
#ifndef VOXRAY_GRID_CELL_GLSL
#define VOXRAY_GRID_CELL_GLSL

#include "shaders/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/scene/octahedral.glsl"

// Averages are weighted by area.
struct GridCell {
    vec3 normal;      // Unit length: of front-side shading normals.
    float distance_;  // Of the surfaces' mean point from the cell's center, along the normal, in cells.
    vec3 albedo;      // Diffuse reflectance.
    float metallic;
    float roughness;
    float reach;      // Surfaces lie this far from the plane with that normal and distance, at most; in cells.
};

// Words: the normal; albedo in 11, 11 and 10 bits; distance, metallic, roughness and reach in 8 bits each, the last one in
// those that count most, so that the largest is found by atomicMax().
const float CELL_DIAGONALS = 1.75;  // Range of distances, in cells: no less than a diagonal.

void storeGridCell(uint number, GridCell c) {
    const uvec3 albedo = uvec3(round(clamp(c.albedo, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0)));
    const vec4 rest = vec4(c.distance_ / CELL_DIAGONALS + 0.5, c.metallic, c.roughness, c.reach / CELL_DIAGONALS);
    const uint at = number * GRID_CELL_WORDS;
    hybridLeaves.cells.data[at] = toOctahedral(c.normal);
    hybridLeaves.cells.data[at + 1u] = albedo.x | albedo.y << 11 | albedo.z << 22;
    hybridLeaves.cells.data[at + 2u] = packUnorm4x8(rest);
}

GridCell gridCell(uint number) {
    const uint at = number * GRID_CELL_WORDS, albedo = hybridLeaves.cells.data[at + 1u];
    const vec4 rest = unpackUnorm4x8(hybridLeaves.cells.data[at + 2u]);
    GridCell c;
    c.normal = fromOctahedral(hybridLeaves.cells.data[at]);
    c.distance_ = (rest.x - 0.5) * CELL_DIAGONALS;
    c.albedo = vec3(albedo & 2047u, albedo >> 11 & 2047u, albedo >> 22) / vec3(2047.0, 2047.0, 1023.0);
    c.metallic = rest.y;
    c.roughness = rest.z;
    c.reach = rest.w * CELL_DIAGONALS;
    return c;
}

// Lets a cell reach as far as `reach` from its plane: rounded up, and a unit more, since the plane is rounded, too.
void widenGridCell(uint number, float reach) {
    const uint at = number * GRID_CELL_WORDS + 2u, units = uint(clamp(ceil(reach / CELL_DIAGONALS * 255.0) + 1.0, 0.0, 255.0));
    atomicMax(hybridLeaves.cells.data[at], units << 24 | (hybridLeaves.cells.data[at] & 0xffffffu));
}

#endif
