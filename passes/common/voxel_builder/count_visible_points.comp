// Adds probe points to the nine counts of their voxels: visible points by face +x -x +y -y +z -z, then all points by
// axis. A point on a surface with unit normal n counts n_a² along axis a, in fixed point with 16 fractional bits. Sums of
// more than 65535 points do not fit and are reported.
#include "passes/common/voxel_builder/probe_point.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer ProbePoints { ProbePoint data[]; } probePoints;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
buffer Counts { uint data[]; } counts;
writeonly buffer Overflow { uint isAny; } overflow;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
} push;

// A hit with a smaller barycentric coordinate may belong to the adjacent triangle.
const float EDGE = 1e-4;

// Whether the ray to one side of a point reaches the point's surface.
bool isVisible(uint ray, uint triangle, vec3 normal, float offset) {
    const Hit hit = hits.data[ray];
    if (hit.triangle == NO_HIT || hit.triangle == triangle) return true;
    // Occluded by a surface in front
    if (hit.t < push.grid.voxelSize - offset) return false;
    // A coincident triangle. At an edge it is an adjacent one of the same surface. Of two that face the same way the
    // ray hits one, so that their area counts once. One that faces the other way is the back of the same sheet, with an
    // area of its own
    if (min(min(hit.u, hit.v), 1.0 - hit.u - hit.v) < EDGE) return true;
    return dot(surfacePoint(hit.triangle, vec2(hit.u, hit.v)).geometricNormal, normal) < 0.0;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const ProbePoint point = probePoints.data[i];
    const vec3 normal = -rays.data[2u * i].direction;
    const float offset = rays.data[2u * i].tMax - push.grid.voxelSize;  // generate_visibility_rays.comp
    const bool frontVisible = isVisible(2u * i, point.triangle, normal, offset);
    const bool backVisible = isVisible(2u * i + 1u, point.triangle, normal, offset);
    const uint voxel = voxelNumber(push.grid, voxelAt(push.grid, point.position));
    if (voxel == NO_VOXEL) return;
    const uint first = 9u * voxel;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const uint weight = uint(round(normal[axis] * normal[axis] * 65536.0));
        if (weight == 0u) continue;
        if (atomicAdd(counts.data[first + 6u + axis], weight) > 0xffffffffu - weight) overflow.isAny = 1u;
        // The front side faces the face that the normal points to, the back side the opposite one
        const uint face = faceOf(normal, axis);
        if (frontVisible) atomicAdd(counts.data[first + face], weight);
        if (backVisible) atomicAdd(counts.data[first + (face ^ 1u)], weight);
    }
}
