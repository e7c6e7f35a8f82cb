// Radiance and opacity of the surfaces in a voxel, by face: level 0 of every layout of radiance voxels. Needs the
// bindings of shaders/voxels/voxels.glsl.
#ifndef VOXRAY_SURFACE_RADIANCE_GLSL
#define VOXRAY_SURFACE_RADIANCE_GLSL

#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"

// By voxel and face +x -x +y -y +z -z: the area that flux arrives at, and the flux (packed_flux.glsl).
layout(scalar) readonly buffer VoxelArea { uint data[]; } voxelArea;
layout(scalar) buffer DirectFluxRef { LargeUints directFlux; };
layout(scalar) buffer IndirectFluxRef { LargeUints indirectFlux; };

vec3 faceFlux(uint face) { return loadFlux(directFlux, face) + loadFlux(indirectFlux, face); }

float faceArea(uint face) { return areaOf(voxelArea.data[face / 2u], face); }

// Opacity of a voxel towards one of its faces: the area that its surfaces project onto that face, over the face's area.
//
//        n = (nx, ny)      A facet of area A and unit normal n stores A nx² for the faces across x and A ny² for those
//           \  ____        across y: these add up to A for any axes. Seen along x it projects the area A nx. So the
//            \/            stored area is divided by nx = sqrt(A nx² / (A nx² + A ny²)).
//            /\
//           /  A
//
// With several facets in the voxel the root mean square replaces nx: exact where they are parallel or perpendicular to
// axes. Surfaces that project more than the whole face occlude each other: the opacity is clamped to 1.
float faceOpacity(VoxelMaterial m, uint face) {
    const vec3 squares = max(m.unoccludedPositive, m.unoccludedNegative);
    const float square = squares[face >> 1];
    if (square <= 0.0) return 0.0;
    return min(unoccluded(m, face) * sqrt((squares.x + squares.y + squares.z) / square), 1.0);
}

// Surfaces emit from their front sides alone, which face along the mean normal.
bool emits(VoxelMaterial m, uint face) {
    return (face & 1u) == 0u ? m.normal[face >> 1] > 0.0 : m.normal[face >> 1] < 0.0;
}

// Whether a dark face is the back of a lit surface. A slanted surface has area at both faces of an axis, though a ray
// along that axis sees one of them:
//
//        lit   /  dark       A ray from the left sees the lit side, with its full opacity. The dark side, inside of a
//      ---->  /              solid, belongs to the opposite face: counted as well, it would darken the voxel.
//            /
//
// So the dark face of a slanted surface that is lit on its other side has no opacity.
bool isBackOfLit(VoxelMaterial m, uint voxel, uint face, float emission) {
    const vec3 squares = max(m.unoccludedPositive, m.unoccludedNegative);
    if (squares[face >> 1] > 0.9 * (squares.x + squares.y + squares.z)) return false;
    const uint opposite = face ^ 1u;
    return faceFlux(6u * voxel + opposite) != vec3(0.0) || (emits(m, opposite) && emission * m.emission != vec3(0.0));
}

// Radiance times opacity, W/(m² sr), and opacity. `emission`: 1 to add what the surfaces emit, 0 to leave it out.
vec4 faceRadiance(VoxelGrid g, uint voxel, uint face, float emission) {
    const VoxelMaterial m = voxelMaterial(voxel);
    const float opacity = faceOpacity(m, face);
    const float area = faceArea(6u * voxel + face) * g.voxelSize * g.voxelSize;
    vec3 radiance = emits(m, face) ? emission * m.emission : vec3(0.0);
    if (area > 0.0) radiance += m.albedo / 3.14159265358979 * faceFlux(6u * voxel + face) / area;
    if (radiance == vec3(0.0) && isBackOfLit(m, voxel, face, emission)) return vec4(0.0);
    return vec4(opacity * radiance, opacity);
}

// The same with one value for all faces: the mean radiance over the unoccluded area, and the opacity of the most opaque
// face.
vec4 meanRadiance(VoxelGrid g, uint voxel, float emission) {
    const VoxelMaterial m = voxelMaterial(voxel);
    vec3 radiance = vec3(0.0);
    float area = 0.0, opacity = 0.0;
    for (uint face = 0u; face < 6u; ++face) {
        const vec4 value = faceRadiance(g, voxel, face, emission);
        if (value.a == 0.0) continue;
        radiance += unoccluded(m, face) / value.a * value.rgb;
        area += unoccluded(m, face);
        opacity = max(opacity, value.a);
    }
    return area > 0.0 ? vec4(opacity / area * radiance, opacity) : vec4(0.0);
}

// The value of a voxel in a grid of one or six directions; 0 for NO_VOXEL.
vec4 voxelRadiance(VoxelGrid g, uint voxel, uint face, float emission) {
    if (voxel == NO_VOXEL) return vec4(0.0);
    return g.directions == 6u ? faceRadiance(g, voxel, face, emission) : meanRadiance(g, voxel, emission);
}

#endif
