// Adds the unshadowed irradiance of a punctual light to the surfels of lit voxels: those of which the light sees a
// point, unless a surface in the adjacent voxel towards the light occludes it (Cosin and Patow 2022, figure 10).
#include "passes/clusters/inject_clusters/lit_points.glsl"
#include "passes/clusters/group_materials.glsl"
#include "passes/clusters/group_patches.glsl"
#include "passes/clusters/voxel_point_rays.glsl"
#include "passes/surfels/surfel_points.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) readonly buffer SurfelIdsRef { LargeUints surfelIds; };
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer SurfelIrradianceRef { SurfelValues surfelIrradiance; };

SurfelGeometry surfelAt(uint i) { return surfelGeometry(surfelIds.data[i], push.pointSeed); }

// Half a voxel in front of an unoccluded surfel.
vec3 pointAbove(SurfelGeometry s) { return s.position + 0.5 * push.grid.voxelSize * s.normal; }

// Whether each of two surfels is in front of the other.
bool faceEachOther(SurfelGeometry p, SurfelGeometry q) {
    return dot(p.normal, pointAbove(q) - p.position) > 0.0 && dot(q.normal, pointAbove(p) - q.position) > 0.0;
}

// Whether light from `direction` is occluded by the back of a group in `voxel` that faces the given group, tested with
// their first surfels. A group that faces the light, such as the continuation of the same plane, does not occlude it.
bool isOccludedBy(uint voxel, SurfaceGroup group, vec3 direction) {
    if (voxel == NO_VOXEL) return false;
    const SurfelGeometry surfel = surfelAt(group.firstSurfel);
    for (uint occluder = firstGroup.data[voxel]; occluder < firstGroup.data[voxel + 1u]; ++occluder)
        if (!isOccluded(groups.data[occluder]) && dot(groupMaterial(occluder).normal, direction) < 0.0 &&
            faceEachOther(surfel, surfelAt(groups.data[occluder].firstSurfel)))
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
        if (isOccluded(group) || isOccludedBy(towardsLight, group, direction)) continue;
        const uint end = groups.data[number + 1u].firstSurfel;
        for (uint k = group.firstSurfel; k < end; ++k) {
            const SurfelGeometry surfel = surfelAt(k);
            const LightSample l = samplePunctual(light, surfel.position);
            surfelIrradiance.data[k] += l.irradiance * max(dot(surfel.normal, l.direction), 0.0);
        }
    }
}
