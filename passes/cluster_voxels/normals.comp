#version 460
#extension GL_GOOGLE_include_directive : require
// The way that each surface voxel looks, by the area that open space lies before. OPEN_SPACE: by where space is open around it
// (Cosin and Patow 2022, section 4.2, figure 7). A thread takes a voxel.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) writeonly buffer Normals { vec3 data[]; } normals;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
} push;

// A plane of area A and unit normal n has the areas A n² at the faces before it: their roots are along n. Bare sheets have the same
// area on both ways; then the front-side normals decide, and where they cancel each other too the largest face.
vec3 normalOfArea(VoxelMaterial m) {
    const vec3 net = m.unoccludedPositive - m.unoccludedNegative;
    const vec3 both = m.unoccludedPositive + m.unoccludedNegative;
    if (dot(abs(net), vec3(1.0)) > 0.01 * dot(both, vec3(1.0))) return normalize(sign(net) * sqrt(abs(net)));
    if (dot(m.normal, m.normal) > 1e-4) return normalize(m.normal);
    return faceNormal(both.x >= both.y && both.x >= both.z ? 0u : both.y >= both.z ? 2u : 4u);
}

#ifdef OPEN_SPACE
uint occupiedBefore(ivec3 voxel, uint face) {
    const int axis = int(face >> 1);
    uint occupied = 0u;
    for (int i = 0; i < 9; ++i) {
        ivec3 at = voxel + ivec3(faceNormal(face));
        at[(axis + 1) % 3] += i % 3 - 1;
        at[(axis + 2) % 3] += i / 3 - 1;
        if (isOccupied(push.grid, at)) ++occupied;
    }
    return occupied;
}

// The way with the fewest occupied voxels of 3 x 3; of several, the one nearest to the normal of the surfaces.
vec3 normalOfOpenSpace(ivec3 voxel, vec3 surface) {
    uint best = 0u, fewest = 10u;
    for (uint face = 0u; face < 6u; ++face) {
        const uint occupied = occupiedBefore(voxel, face);
        const bool isNearer = dot(faceNormal(face), surface) > dot(faceNormal(best), surface) + 1e-4;
        if (occupied > fewest || (occupied == fewest && !isNearer)) continue;
        fewest = occupied;
        best = face;
    }
    return faceNormal(best);
}
#endif

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const VoxelMaterial m = voxelMaterial(voxel);
    vec3 normal = normalOfArea(m);
#ifdef OPEN_SPACE
    // One plane's normal needs no help.
    if (dot(m.normal, m.normal) < 0.98) normal = normalOfOpenSpace(ivec3(coordinates.data[voxel]), normal);
#endif
    normals.data[voxel] = normal;
}
