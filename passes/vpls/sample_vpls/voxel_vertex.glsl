// Vertices of light paths at surface voxels.
#include "passes/inject/light_paths/light_bounce.glsl"
#include "shaders/voxel_march/surface_segment.glsl"
#include "shaders/voxels/voxels.glsl"

// The mean normal of a voxel's surfaces, flipped towards where a ray along `direction` comes from. Where most normals
// cancel, as in thin shells, the opposite of the direction.
vec3 voxelNormal(VoxelMaterial m, vec3 direction) {
    if (length(m.normal) < 0.5) return -direction;
    const vec3 n = normalize(m.normal);
    return dot(n, direction) <= 0.0 ? n : -n;
}

// The vertex where a ray along `direction` enters a surface voxel, at `position`: up to a voxel's diagonal in front of
// the surface.
LightVertex voxelVertex(uint voxel, vec3 position, vec3 direction) {
    const VoxelMaterial m = voxelMaterial(voxel);
    const vec3 n = voxelNormal(m, direction);
    return LightVertex(position, n, n, clamp(m.albedo, 0.0, 1.0), pointOffset(position));
}

// Origin of a ray from a surface point, off the surface's voxels. In a voxel of another surface the ray starts there if
// it goes towards that surface, which it then hits, and behind the voxel if it comes from it.
vec3 rayOriginOffVoxels(VoxelGrid g, vec3 position, vec3 normal, vec3 direction) {
    const vec3 origin = offsetFromSurface(g, position, normal);
    const uint voxel = voxelNumber(g, voxelAt(g, origin));
    if (voxel == NO_VOXEL || dot(voxelMaterial(voxel).normal, direction) < 0.0) return origin;
    return offsetRayOrigin(g, position, normal, direction);
}
