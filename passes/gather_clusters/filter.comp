#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of faces averaged with the same faces of the sides round them that look into the same space, by binomial weights; faces
// without surfaces weigh nothing (Cosin and Patow 2022, section 4.4, whose filter also crosses walls). A thread takes a side, whose
// materials are bound.
#include "shaders/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;  // Of voxels.
readonly buffer FirstNeighbour { uint data[]; } firstNeighbour;
layout(scalar) readonly buffer NeighboursAt { LargeUints neighbours; };
layout(scalar) readonly buffer FacesAt { FaceValues faces; };
layout(scalar) readonly buffer FilteredAt { FaceValues filtered; };
layout(push_constant) uniform Push { uint count; } push;

// 1 2 1 along each axis.
float weightAt(vec3 between) {
    const vec3 weight = 2.0 - abs(between);
    return weight.x * weight.y * weight.z;
}

void addFaces(uint side, float weight, inout vec4 sum[6]) {
    const VoxelMaterial m = voxelMaterial(side);
    for (uint face = 0u; face < 6u; ++face)
        if (unoccluded(m, face) > 0.0) sum[face] += weight * vec4(faces.data[6u * side + face], 1.0);
}

void main() {
    const uint side = linearIndex();
    if (side >= push.count) return;
    vec4 sum[6];
    for (uint face = 0u; face < 6u; ++face) sum[face] = vec4(0.0);
    addFaces(side, weightAt(vec3(0.0)), sum);
    const vec3 center = vec3(coordinates.data[sides.data[side].voxel]);
    for (uint i = firstNeighbour.data[side]; i < firstNeighbour.data[side + 1u]; ++i) {
        const uint other = neighbours.data[i];
        if (other != NO_SIDE) addFaces(other, weightAt(vec3(coordinates.data[sides.data[other].voxel]) - center), sum);
    }
    for (uint face = 0u; face < 6u; ++face)
        filtered.data[6u * side + face] = sum[face].w > 0.0 ? sum[face].rgb / sum[face].w : vec3(0.0);
}
