// Marks the voxel faces that the shading of gather rays will read: see irradianceAt() in shaders/voxels/face_lookup.glsl.
#include "shaders/voxels/face.glsl"
#include "shaders/view/gather_layout.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
uniform sampler2D position;
buffer Asked { uint data[]; } asked;             // A bit a face, by voxel.
readonly buffer Measured { uint data[]; } measured;  // The same: faces that have surfels.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
} push;

// The area that irradianceAt() will find: a face without surfels stays unknown.
float knownArea(uint voxel, vec3 normal) {
    const VoxelMaterial m = voxelMaterial(voxel);
    const uint known = measured.data[voxel];
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

// Few voxels are asked for by many rays: look before the atomic.
void mark(uint voxel, uint faces) {
    if ((asked.data[voxel] & faces) != faces) atomicOr(asked.data[voxel], faces);
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
    const vec3 from = texelFetch(position, texel, 0).xyz;
    const vec3 normal = dot(s.geometricNormal, from - s.position) >= 0.0 ? s.geometricNormal : -s.geometricNormal;
    const uint faces = push.grid.directions == 1u ? 63u : faceBits(normal);

    const ivec3 cell = voxelAt(push.grid, s.position);
    const uint own = voxelNumber(push.grid, cell);
    float area = 0.0;
    if (own != NO_VOXEL) {
        mark(own, faces);
        area = knownArea(own, normal);
    }
    for (int k = 0; k < 27 && area < SMALL_FACE_AREA; ++k) {
        const uint voxel = voxelNumber(push.grid, cell + ivec3(k % 3, (k / 3) % 3, k / 9) - 1);
        if (k == 13 || voxel == NO_VOXEL) continue;
        mark(voxel, faces);
        area += knownArea(voxel, normal);
    }
}
