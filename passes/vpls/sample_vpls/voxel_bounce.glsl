// Rays of light that surface voxels reflect.
#include "passes/inject/light_paths/light_bounce.glsl"
#include "shaders/voxel_march/surface_segment.glsl"
#include "shaders/voxels/voxels.glsl"

// The mean normal of a voxel's surfaces on the side that a ray along `direction` comes from; where most of them cancel, as those of
// thin shells do, the light goes back to where it came from.
vec3 voxelNormal(VoxelMaterial m, vec3 direction) {
    if (length(m.normal) < 0.5) return -direction;
    const vec3 n = normalize(m.normal);
    return dot(n, direction) <= 0.0 ? n : -n;
}

// What a ray along `direction` hits of surface voxel `number` where it enters it, at `position`: in the open, up to the voxel's
// diagonal before the surface.
LitPoint litVoxel(uint number, vec3 position, vec3 direction) {
    const VoxelMaterial m = voxelMaterial(number);
    const vec3 n = voxelNormal(m, direction);
    return LitPoint(position, n, n, clamp(m.albedo, 0.0, 1.0), pointOffset(position));
}

// Where a ray from a point of a surface begins: off its surface's voxels. In another surface's voxel it begins there if it goes towards
// that surface, which it then hits, and behind the voxel if it comes from it.
vec3 beginInVoxels(VoxelGrid g, vec3 position, vec3 normal, vec3 direction) {
    const vec3 from = offSurface(g, position, normal);
    const uint number = voxelNumber(g, voxelAt(g, from));
    if (number == NO_VOXEL || dot(voxelMaterial(number).normal, direction) < 0.0) return from;
    return beginOffSurface(g, position, normal, direction);
}
