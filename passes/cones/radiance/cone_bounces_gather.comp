// Flux that arrives at the faces of surface voxels, by a set of cones through radiance voxels from the voxel's center.
// A thread gathers for the two faces across an axis, which share a word.
#include "passes/cones/radiance/cone_set.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/surface_radiance.glsl"
#include "shaders/voxels/mean_normal.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer VoxelCoordinates { uvec3 data[]; } voxelCoordinates;
layout(scalar) buffer FluxRef { LargeUints flux; };
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint voxels;
    uint firstPair;  // By axis, then by voxel, so that adjacent threads have coherent work.
    uint pairs;
    uint coneCount;
} push;

// Flux at a face, W.
vec3 gather(uint voxel, uint face) {
    const uint index = 6u * voxel + face;
    const float area = faceArea(index) * push.grid.voxelSize * push.grid.voxelSize;
    const VoxelMaterial m = voxelMaterial(voxel);
    // Insides of solids stay dark. They are recognized by the injected light, whose rays know what is occluded.
    const bool inside = faceFlux(index) == vec3(0.0) && isBackOfLit(m, voxel, face, 0.0);
    if (area == 0.0 || inside) return vec3(0.0);
    const uvec3 coordinates = voxelCoordinates.data[voxel];
    const vec3 normal = meanNormal(m.normal, faceNormal(face));
    const vec3 center = push.grid.origin + (vec3(coordinates) + 0.5) * push.grid.voxelSize;
    // The cones' positions in their strata vary from voxel to voxel, by the additive recurrence of Roberts 2018 along
    // each axis.
    const vec3 dither = fract(vec3(0.5) + float(coordinates.x) * vec3(0.754877666, 0.569840296, 0.819172513) +
                              float(coordinates.y) * vec3(0.569840296, 0.754877666, 0.671043607) +
                              float(coordinates.z) * vec3(0.671043607, 0.819172513, 0.549700478));
    return area * coneIrradiance(center, normal, normal, push.coneCount, dither);
}

void main() {
    const uint i = linearIndex();
    if (i >= push.pairs) return;
    const uint voxel = (push.firstPair + i) % push.voxels, axis = (push.firstPair + i) / push.voxels;
    const vec3 positive = gather(voxel, 2u * axis), negative = gather(voxel, 2u * axis + 1u);
    storeFlux(flux, 3u * voxel + axis, positive, negative);
}
