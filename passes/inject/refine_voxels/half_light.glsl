// Light of voxels from two halves of the rays, direct and indirect, by voxel face.
#ifndef VOXRAY_HALF_LIGHT_GLSL
#define VOXRAY_HALF_LIGHT_GLSL

#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxel_levels.glsl"

layout(scalar) buffer DirectARef { LargeUints directA; };
layout(scalar) buffer IndirectARef { LargeUints indirectA; };
layout(scalar) buffer DirectBRef { LargeUints directB; };
layout(scalar) buffer IndirectBRef { LargeUints indirectB; };
layout(scalar) readonly buffer Area { uint data[]; } area;

// Flux over the area of a voxel's face, W/m², by each half, and the area that it falls on, in voxel faces.
struct HalfLight {
    vec3 a;
    vec3 b;
    float area;
};

HalfLight halfLight(uint face, float voxelSize) {
    HalfLight light = HalfLight(vec3(0.0), vec3(0.0), areaOf(area.data[face / 2u], face));
    const float scale = 1.0 / (voxelSize * voxelSize);
    light.a = scale * (loadFlux(directA, face) + loadFlux(indirectA, face));
    light.b = scale * (loadFlux(directB, face) + loadFlux(indirectB, face));
    return light;
}

#endif
