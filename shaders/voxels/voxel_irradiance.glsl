// Interpolated irradiance at a point of a surface, from the flux and area of voxels.
#ifndef VOXRAY_VOXEL_IRRADIANCE_GLSL
#define VOXRAY_VOXEL_IRRADIANCE_GLSL

#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) buffer VoxelFluxRef { LargeUints voxelFlux; };
layout(scalar) readonly buffer VoxelArea { uint data[]; } voxelArea;

// Adds the flux and the area of voxels around a point, with tent weights of `radius` voxels. `weightByAxis`, `face`:
// weights and indices of the three faces that the surface faces.
void addVoxels(VoxelGrid g, vec3 position, vec3 weightByAxis, uvec3 face, float radius, inout vec3 flux,
               inout float area) {
    const vec3 center = (position - g.origin) / g.voxelSize - 0.5;
    const ivec3 first = max(ivec3(ceil(center - radius)), ivec3(0));
    const ivec3 last = min(ivec3(floor(center + radius)), ivec3(g.resolution) - 1);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const uint voxel = voxelNumber(g, ivec3(x, y, z));
                if (voxel == NO_VOXEL) continue;
                const vec3 tent = max(1.0 - abs(vec3(x, y, z) - center) / radius, 0.0);
                const vec3 weight = weightByAxis * (tent.x * tent.y * tent.z);
                const uint faces = g.directions == 1u ? 6u : 3u;
                for (uint k = 0u; k < faces; ++k) {
                    const float faceWeight = faces == 6u ? tent.x * tent.y * tent.z : weight[k];
                    const uint index = voxel * 6u + (faces == 6u ? k : face[k]);
                    area += faceWeight * areaOf(voxelArea.data[index / 2u], index);
                    flux += faceWeight * loadFlux(voxelFlux, index);
                }
            }
}

// Irradiance (W/m²) on a surface at `position` with unit normal `normal`.
//
// Flux and area are interpolated separately, with tent weights of `radius` voxels, and divided last: voxels with little
// surface have little weight, and a half-lit voxel has half the irradiance. Areas are sampled: where less than a tenth
// of a voxel's face is found, the radius is doubled, up to twice (GatherIrradiance::reach()). In a grid of one
// direction all six faces have equal weights.
//
// With `sevenTap` the sum is over seven points: `position`, and those one voxel away along each axis.
vec3 voxelIrradiance(VoxelGrid g, vec3 position, vec3 normal, float radius, bool sevenTap) {
    const vec3 weightByAxis = normal * normal;
    const uvec3 face = uvec3(normal.x < 0.0 ? 1u : 0u, normal.y < 0.0 ? 3u : 2u, normal.z < 0.0 ? 5u : 4u);
    for (int attempt = 0; attempt < 3; ++attempt, radius *= 2.0) {
        vec3 flux = vec3(0.0);
        float area = 0.0;
        addVoxels(g, position, weightByAxis, face, radius, flux, area);
        for (int tap = 0; sevenTap && tap < 6; ++tap) {
            vec3 offset = vec3(0.0);
            offset[tap / 2] = tap % 2 == 0 ? g.voxelSize : -g.voxelSize;
            addVoxels(g, position + offset, weightByAxis, face, radius, flux, area);
        }
        if (area > 0.1 || attempt == 2) return flux / (max(area, 0.1) * g.voxelSize * g.voxelSize);
    }
    return vec3(0.0);
}

// The same by the dominant face of the normal only, bilinearly interpolated between four voxels in the point's layer
// across its axis (Cosin and Patow 2022, section 4.5), or of the point's own voxel. Where these have too little area, and
// in grids of one direction, as voxelIrradiance().
vec3 dominantFaceIrradiance(VoxelGrid g, vec3 position, vec3 normal, bool interpolates) {
    const vec3 size = abs(normal);
    const uint axis = size.x >= max(size.y, size.z) ? 0u : size.y >= size.z ? 1u : 2u;
    const uint face = 2u * axis + (normal[axis] < 0.0 ? 1u : 0u);
    vec3 center = (position - g.origin) / g.voxelSize - 0.5;
    center[axis] = floor(center[axis] + 0.5);
    if (!interpolates) center = floor(center + 0.5);
    const vec3 corner = floor(center), fraction = center - corner;
    vec3 flux = vec3(0.0);
    float area = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        ivec3 offset = ivec3(0);
        offset[(axis + 1u) % 3u] = int(i & 1u);
        offset[(axis + 2u) % 3u] = int(i >> 1);
        const uint voxel = voxelNumber(g, ivec3(corner) + offset);
        if (voxel == NO_VOXEL) continue;
        const vec3 tent = mix(1.0 - fraction, fraction, vec3(offset));
        const float weight = tent.x * tent.y * tent.z;
        const uint index = voxel * 6u + face;
        area += weight * areaOf(voxelArea.data[index / 2u], index);
        flux += weight * loadFlux(voxelFlux, index);
    }
    if (area <= 0.1 || g.directions == 1u) return voxelIrradiance(g, position, normal, 1.0, false);
    return flux / (area * g.voxelSize * g.voxelSize);
}

#endif
