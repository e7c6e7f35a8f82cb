#version 460
#extension GL_GOOGLE_include_directive : require
// What rays from faces see of the voxels: a thread walks one ray.
#include "passes/cluster_visibility/face_ray.glsl"
#include "shaders/voxel_march/voxel_march.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Targets { uint data[]; } targets;
buffer Missed { uint count; } missed;

// Where a ray leaves a voxel that it is in, and a little on, m.
float leaves(ivec3 voxel, vec3 origin, vec3 direction) {
    const vec3 at = inVoxels(push.grid, origin), far = mix(vec3(voxel), vec3(voxel) + 1.0, greaterThan(direction, vec3(0.0)));
    const vec3 parts = mix((far - at) / direction, vec3(1.0e30), lessThan(abs(direction), vec3(1e-9)));
    return (min(parts.x, min(parts.y, parts.z)) + VOXEL_MARGIN) * push.grid.voxelSize;
}

uint seenBy(uint ray) {
    vec3 origin, direction, normal;
    faceRay(ray, origin, direction, normal);
    const float pick = rayPick(ray);
    float from = 0.0;
    bool isInLayer = true;
    // No ray passes more voxels than the grid has along its axes.
    const uint voxels = push.grid.resolution.x + push.grid.resolution.y + push.grid.resolution.z;
    for (uint i = 0u; i < voxels; ++i) {
        VoxelHit hit;
        if (!closest(push.grid, origin, direction, from, 1.0e30, hit)) break;
        const uint voxel = voxelNumber(push.grid, hit.voxel);
        const VoxelMaterial m = voxelMaterial(voxel);
        // In a corner a ray begins among the voxels of the other surface, on its front side, for that is where corners are lit: as long
        // as it passes from one of them to the next that surface lies behind it.
        isInLayer = isInLayer && hit.t <= from + 2.0 * VOXEL_MARGIN * push.grid.voxelSize;
        const bool isBehind = isInLayer && isFlat(m) && dot(m.normal, direction) > 0.0;
        uint target;
        if (!isBehind && !isOwnSurface(ray, normal, direction, hit.voxel, m) &&
            seesVoxel(ray, voxel, seenFace(m, direction, pick), hit.t / push.grid.voxelSize, target)) return target;
        from = max(leaves(hit.voxel, origin, direction), from + VOXEL_MARGIN * push.grid.voxelSize);
    }
    atomicAdd(missed.count, 1u);
    return NO_TARGET;
}

void main() {
    const uint ray = linearIndex();
    if (ray < push.rays) targets.data[ray] = seenBy(ray);
    countMarch();
}
