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
    float coverage;   // Area of surfaces over that of the cell's face, as seen along the axis where it is largest; at most 1.
    float metallic;
    float roughness;
};

// Words: the normal; albedo in 11, 11 and 10 bits; coverage, distance, metallic and roughness in 8 bits each.
void storeGridCell(uint number, GridCell c) {
    const uvec3 albedo = uvec3(round(clamp(c.albedo, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0)));
    const vec4 rest = vec4(c.coverage, c.distance_ / 1.75 + 0.5, c.metallic, c.roughness);
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
    c.distance_ = (rest.y - 0.5) * 1.75;
    c.albedo = vec3(albedo & 2047u, albedo >> 11 & 2047u, albedo >> 22) / vec3(2047.0, 2047.0, 1023.0);
    c.coverage = rest.x;
    c.metallic = rest.z;
    c.roughness = rest.w;
    return c;
}

#endif
