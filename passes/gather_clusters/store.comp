#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of faces as flux over their unoccluded area. A thread takes the two faces across an axis of a voxel.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(scalar) readonly buffer FacesAt { FaceValues faces; };
layout(scalar) buffer FluxAt { LargeUints flux; };
writeonly buffer Area { uint data[]; } area;
layout(push_constant) uniform Push {
    uint pairs;
    float voxelFaceArea;  // m²
} push;

void main() {
    const uint pair = linearIndex();
    if (pair >= push.pairs) return;
    const VoxelMaterial m = voxelMaterial(pair / 3u);
    const uint axis = pair % 3u;
    const float positive = m.unoccludedPositive[axis], negative = m.unoccludedNegative[axis];
    storeFlux(flux, pair, positive * push.voxelFaceArea * faces.data[2u * pair],
              negative * push.voxelFaceArea * faces.data[2u * pair + 1u]);
    area.data[pair] = packAreas(positive, negative);
}
