// Copies hits of the previous build that are still valid. Flags the other rays, which are traced again: those that
// start in a changed voxel, that hit a surface close to one, or that intersect a changed box before their hit.
#include "passes/clusters/cluster_visibility/patch_ray.glsl"
#include "passes/common/compute/changed_boxes.glsl"
#include "shaders/compute/large_buffer.glsl"
layout(local_size_x = 64) in;

// Packed hits of each chunk, with previous indices of groups.
layout(scalar) readonly buffer PreviousHits { LargeUints data[]; } previousHits;
readonly buffer NewGroupIndex { uint data[]; } newGroupIndex;
readonly buffer PreviousFirstPatches { uint data[]; } previousFirstPatches;
writeonly buffer PackedHits { uint data[]; } packedHits;
buffer Flags { uint words[]; } flags;  // Must be 0 before.

uint previousHit(uint ray) {
    const uint patchNumber = push.firstPatch + ray / push.listLayout.raysPerPatch;
    const uint group = patchFaces.data[patchNumber] / 6u;
    if (previousFirstPatches.data[group] == NO_GROUP) return HIT_UNKNOWN;
    const uint previous = previousFirstPatches.data[group] + patchNumber - groups.data[group].firstPatch;
    const uint packedHit =
        previousHits.data[previous / push.listLayout.patchesPerChunk]
            .data[previous % push.listLayout.patchesPerChunk * push.listLayout.raysPerPatch + ray % push.listLayout.raysPerPatch];
    // The position of a hit without a group is not stored
    if (!hitsGroup(packedHit)) return packedHit == HIT_NO_GROUP ? HIT_UNKNOWN : packedHit;
    const uint newGroup = newGroupIndex.data[hitGroup(packedHit)];
    return newGroup == NO_GROUP ? HIT_UNKNOWN : withGroup(packedHit, newGroup);
}

// Whether a ray intersects a changed box before its hit, which is within two voxels of the hit group's surfels.
bool changes(uint ray, uint packedHit) {
    Ray r = patchRay(ray);
    if (hitsGroup(packedHit)) {
        const vec3 toGroup = patchSurfels.data[groups.data[hitGroup(packedHit)].firstSurfel].position - r.origin;
        r.tMax = min(r.tMax, length(toGroup) + 3.5 * push.grid.voxelSize);
    }
    return intersectsChangedBox(r);
}

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rayCount) return;
    uint packedHit = previousHit(ray);
    if (packedHit != HIT_UNKNOWN && changes(ray, packedHit)) packedHit = HIT_UNKNOWN;
    packedHits.data[ray] = packedHit;
    if (packedHit == HIT_UNKNOWN) atomicOr(flags.words[ray / 32u], 1u << (ray % 32u));
}
