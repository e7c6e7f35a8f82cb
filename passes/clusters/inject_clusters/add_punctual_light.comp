// Adds the unshadowed irradiance of a punctual light to the surfels of lit voxels: those of which the light sees a
// point, unless a surface in the adjacent voxel towards the light occludes it (Cosin and Patow 2022, figure 10).
#include "passes/clusters/inject_clusters/lit_points.glsl"
#include "passes/clusters/grouped_surfels.glsl"
#include "passes/clusters/voxel_point_rays.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer SurfelIrradianceRef { SurfelValues surfelIrradiance; };

// Whether each of two groups is in front of the other, tested with their first surfels.
bool faceEachOther(SurfaceGroup a, SurfaceGroup b) {
    const GroupedSurfel p = groupedSurfels.data[a.firstSurfel], q = groupedSurfels.data[b.firstSurfel];
    return dot(p.normal, b.pointAbove - p.position) > 0.0 && dot(q.normal, a.pointAbove - q.position) > 0.0;
}

// Whether light from `direction` is occluded by the back of a group in `voxel` that faces the given group. A group that
// faces the light, such as the continuation of the same plane, does not occlude it.
bool isOccludedBy(uint voxel, SurfaceGroup group, vec3 direction) {
    if (voxel == NO_VOXEL) return false;
    for (uint occluder = firstGroup.data[voxel]; occluder < firstGroup.data[voxel + 1u]; ++occluder)
        if (groups.data[occluder].isOccluded == 0u && dot(voxelMaterial(occluder).normal, direction) < 0.0 &&
            faceEachOther(group, groups.data[occluder]))
            return true;
    return false;
}

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels || !anyUnoccluded(i * POINTS, POINTS)) return;
    const uint voxel = push.firstVoxel + i;
    const GpuLight light = sceneLights.data[push.light];
    const vec3 direction = samplePunctual(light, voxelCenter(push.grid, voxel)).direction, size = abs(direction);
    const ivec3 offset = ivec3(round(direction / max(size.x, max(size.y, size.z))));
    const uint towardsLight = voxelNumber(push.grid, ivec3(coordinates.data[voxel]) + offset);
    for (uint number = firstGroup.data[voxel]; number < firstGroup.data[voxel + 1u]; ++number) {
        const SurfaceGroup group = groups.data[number];
        // No point around the voxel lies in its gaps
        if (group.isOccluded == 1u || isOccludedBy(towardsLight, group, direction)) continue;
        for (uint k = group.firstSurfel; k < group.firstSurfel + group.surfelCount; ++k) {
            const GroupedSurfel surfel = groupedSurfels.data[k];
            const LightSample l = samplePunctual(light, surfel.position);
            surfelIrradiance.data[k] += l.irradiance * max(dot(surfel.normal, l.direction), 0.0);
        }
    }
}
