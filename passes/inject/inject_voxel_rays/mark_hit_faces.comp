// Marks the voxel faces that irradianceAt() (shaders/voxels/face_lookup.glsl) will read at the hits of gather rays.
#include "shaders/voxels/face.glsl"
#include "shaders/view/gather_layout.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
uniform sampler2D position;
buffer HitFaces { uint data[]; } hitFaces;  // One bit per face, by voxel.
readonly buffer FacesWithSurfels { uint data[]; } facesWithSurfels;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
} push;

// The area that irradianceAt() will find; faces without surfels stay unknown.
float knownArea(uint voxel, vec3 normal) {
    const VoxelMaterial m = voxelMaterial(voxel);
    const uint known = facesWithSurfels.data[voxel];
    float area = 0.0;
    for (uint face = 0u; face < 6u; ++face) {
        if ((known >> face & 1u) == 0u) continue;
        const uint axis = face >> 1;
        if (push.grid.directions == 1u)
            area += unoccluded(m, face);
        else if (face == faceOf(normal, axis))
            area += normal[axis] * normal[axis] * unoccluded(m, face);
    }
    return area;
}

// Many rays hit the same faces: a read saves most atomics.
void mark(uint voxel, uint faces) {
    if ((hitFaces.data[voxel] & faces) != faces) atomicOr(hitFaces.data[voxel], faces);
}

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.rays) return;
    const Hit hit = hits.data[i];
    if (hit.triangle == NO_HIT) return;
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return;
    const uint blockIndex = push.firstBlock + i / g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const ivec2 texel = ivec2(texelOf(g, block, rayTexel(g, block, i % g.raysPerBlock)));
    const vec3 origin = texelFetch(position, texel, 0).xyz;
    const vec3 normal = dot(s.geometricNormal, origin - s.position) >= 0.0 ? s.geometricNormal : -s.geometricNormal;
    const uint faces = push.grid.directions == 1u ? 63u : faceBits(normal);

    const ivec3 center = voxelAt(push.grid, s.position);
    const uint hitVoxel = voxelNumber(push.grid, center);
    float area = 0.0;
    if (hitVoxel != NO_VOXEL) {
        mark(hitVoxel, faces);
        area = knownArea(hitVoxel, normal);
    }
    for (int k = 0; k < 27 && area < SMALL_FACE_AREA; ++k) {
        const uint voxel = voxelNumber(push.grid, center + ivec3(k % 3, (k / 3) % 3, k / 9) - 1);
        if (k == 13 || voxel == NO_VOXEL) continue;
        mark(voxel, faces);
        area += knownArea(voxel, normal);
    }
}
