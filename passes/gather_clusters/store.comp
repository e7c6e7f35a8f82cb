#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of the faces of the open sides in a voxel (whose materials are bound) as its flux over their unoccluded area. A thread
// takes the two faces across an axis of a voxel.
#include "shaders/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer FirstSide { uint data[]; } firstSide;
layout(scalar) readonly buffer FacesAt { FaceValues faces; };
layout(scalar) readonly buffer SidesDirectAt { FaceValues sidesDirect; };
layout(scalar) buffer DirectAt { LargeUints direct; };
layout(scalar) buffer IndirectAt { LargeUints indirect; };
writeonly buffer Area { uint data[]; } area;
layout(push_constant) uniform Push {
    uint pairs;
    float voxelFaceArea;  // m²
} push;

void main() {
    const uint pair = linearIndex();
    if (pair >= push.pairs) return;
    const uint voxel = pair / 3u, axis = pair % 3u;
    vec3 directFlux[2] = vec3[](vec3(0.0), vec3(0.0)), indirectFlux[2] = vec3[](vec3(0.0), vec3(0.0));
    float own[2] = float[](0.0, 0.0);
    for (uint side = firstSide.data[voxel]; side < firstSide.data[voxel + 1u]; ++side) {
        if (sides.data[side].isCovered == 1u) continue;
        const VoxelMaterial m = voxelMaterial(side);
        for (uint k = 0u; k < 2u; ++k) {
            const uint face = 2u * axis + k;
            const float part = unoccluded(m, face);
            own[k] += part;
            directFlux[k] += part * push.voxelFaceArea * sidesDirect.data[6u * side + face];
            indirectFlux[k] += part * push.voxelFaceArea * faces.data[6u * side + face];
        }
    }
    storeFlux(direct, pair, directFlux[0], directFlux[1]);
    storeFlux(indirect, pair, indirectFlux[0], indirectFlux[1]);
    area.data[pair] = packAreas(own[0], own[1]);
}
