// Radiance and cover of the surfaces in a voxel: level 0 of every layout of radiance voxels. Needs the bindings of
// shaders/voxels/voxels.glsl.
#ifndef VOXRAY_SURFACE_RADIANCE_GLSL
#define VOXRAY_SURFACE_RADIANCE_GLSL

#include "shaders/voxels/voxels.glsl"

// By voxel and facing direction +x -x +y -y +z -z: W, 3 floats each; area that the flux fell on, in units of a voxel's face.
layout(scalar) readonly buffer VoxelArea { float data[]; } voxelArea;
layout(scalar) readonly buffer DirectFluxAt { LargeFloats directFlux; };
layout(scalar) readonly buffer IndirectFluxAt { LargeFloats indirectFlux; };

vec3 faceFlux(uint face) {
    const uint at = 3u * face;
    return vec3(directFlux.data[at], directFlux.data[at + 1u], directFlux.data[at + 2u]) +
           vec3(indirectFlux.data[at], indirectFlux.data[at + 1u], indirectFlux.data[at + 2u]);
}

float exposed(VoxelMaterial m, uint face) {
    return (face & 1u) == 0u ? m.unoccludedPositive[face >> 1] : m.unoccludedNegative[face >> 1];
}

// Area that a voxel's surfaces show along the axis of `face`, by the side that they face, in units of the voxel's face. The exposed
// area of a facet is shared out by the squares of its normal's components, and along an axis it shows its area times the component
// itself: so the share is divided by the component. Of several facets the root of the mean square stands for it, which is exact
// where they are parallel or lie across the axes. What shows more than the voxel's face hides itself.
float faceCover(VoxelMaterial m, uint face) {
    const vec3 squares = max(m.unoccludedPositive, m.unoccludedNegative);
    const float own = squares[face >> 1];
    if (own <= 0.0) return 0.0;
    return min(exposed(m, face) * sqrt((squares.x + squares.y + squares.z) / own), 1.0);
}

// Emission is of the front sides alone, and these face as the mean normal does.
bool emits(VoxelMaterial m, uint face) {
    return (face & 1u) == 0u ? m.normal[face >> 1] > 0.0 : m.normal[face >> 1] < 0.0;
}

// A sheet at a slant to the axes faces a ray with parts of both of its sides: with the true one, and with less of the other, which it
// does not show. So where one side of it is dark and the other lit, as within a solid, the dark one is left out.
bool isBackOfLit(VoxelMaterial m, uint voxel, uint face, float emission) {
    const vec3 squares = max(m.unoccludedPositive, m.unoccludedNegative);
    if (squares[face >> 1] > 0.9 * (squares.x + squares.y + squares.z)) return false;
    const uint other = face ^ 1u;
    return faceFlux(6u * voxel + other) != vec3(0.0) || (emits(m, other) && emission * m.emission != vec3(0.0));
}

// Radiance times cover, W/(m² sr), and cover. `emission`: 1 to add what the surfaces emit, 0 to leave it out.
vec4 faceRadiance(VoxelGrid g, uint voxel, uint face, float emission) {
    const VoxelMaterial m = voxelMaterials.data[voxel];
    const float cover = faceCover(m, face);
    const float area = voxelArea.data[6u * voxel + face] * g.voxelSize * g.voxelSize;
    vec3 radiance = emits(m, face) ? emission * m.emission : vec3(0.0);
    if (area > 0.0) radiance += m.albedo / 3.14159265358979 * faceFlux(6u * voxel + face) / area;
    if (radiance == vec3(0.0) && isBackOfLit(m, voxel, face, emission)) return vec4(0.0);
    return vec4(cover * radiance, cover);
}

// The same for all sides together: the mean radiance over exposed area, and the cover of the side that shows most.
vec4 meanRadiance(VoxelGrid g, uint voxel, float emission) {
    const VoxelMaterial m = voxelMaterials.data[voxel];
    vec3 radiance = vec3(0.0);
    float area = 0.0, cover = 0.0;
    for (uint face = 0u; face < 6u; ++face) {
        const vec4 value = faceRadiance(g, voxel, face, emission);
        if (value.a == 0.0) continue;
        radiance += exposed(m, face) / value.a * value.rgb;
        area += exposed(m, face);
        cover = max(cover, value.a);
    }
    return area > 0.0 ? vec4(cover / area * radiance, cover) : vec4(0.0);
}

#endif
