// Adds the irradiance of a punctual light, as if nothing hid it, to the surfels of the voxels of a batch that are lit: the light sees a
// point round the voxel, and nothing in the next voxel towards the light turns its back to it (Cosin and Patow 2022, figure 10). A
// thread takes a voxel.
#include "passes/clusters/inject_clusters/lit_points.glsl"
#include "passes/clusters/patches.glsl"
#include "passes/clusters/point_rays.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
readonly buffer FirstSide { uint data[]; } firstSide;
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer PlacedAt { SurfelValues placed; };

// Whether each of two sides lies before the other, by their first surfels.
bool faceEachOther(SurfaceSide a, SurfaceSide b) {
    const PatchSurfel p = patchSurfels.data[a.firstSurfel], q = patchSurfels.data[b.firstSurfel];
    return dot(p.normal, b.raised - p.position) > 0.0 && dot(q.normal, a.raised - q.position) > 0.0;
}

// Whether a side in the voxel `next` that faces this one looks away from the light: light would have to come through its surface. What
// looks towards the light, as the rest of the same plane does however low it stands, hides nothing.
bool isHiddenBy(uint next, SurfaceSide side, vec3 direction) {
    if (next == NO_VOXEL) return false;
    for (uint other = firstSide.data[next]; other < firstSide.data[next + 1u]; ++other)
        if (sides.data[other].isCovered == 0u && dot(voxelMaterial(other).normal, direction) < 0.0 &&
            faceEachOther(side, sides.data[other]))
            return true;
    return false;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels || !arrives(i * POINTS, POINTS)) return;
    const uint voxel = push.firstVoxel + i;
    const GpuLight light = sceneLights.data[push.light];
    const vec3 direction = samplePunctual(light, voxelCenter(push.grid, voxel)).direction, size = abs(direction);
    const ivec3 step_ = ivec3(round(direction / max(size.x, max(size.y, size.z))));
    const uint next = voxelNumber(push.grid, ivec3(coordinates.data[voxel]) + step_);
    for (uint side = firstSide.data[voxel]; side < firstSide.data[voxel + 1u]; ++side) {
        const SurfaceSide s = sides.data[side];
        // No point round the voxel lies in its gaps
        if (s.isCovered == 1u || isHiddenBy(next, s, direction)) continue;
        for (uint k = s.firstSurfel; k < s.firstSurfel + s.surfels; ++k) {
            const PatchSurfel surfel = patchSurfels.data[k];
            const LightSample l = samplePunctual(light, surfel.position);
            placed.data[k] += l.irradiance * max(dot(surfel.normal, l.direction), 0.0);
        }
    }
}
