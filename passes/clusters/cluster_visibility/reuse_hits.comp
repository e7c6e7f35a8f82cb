// Copies hits of the previous build that are still valid. Flags the other rays, which are traced again: those that
// start in a changed voxel, that hit a surface close to one, or that intersect a changed box before their hit.
#include "passes/clusters/cluster_visibility/patch_ray.glsl"
#include "shaders/compute/large_buffer.glsl"
layout(local_size_x = 64) in;

struct Box {
    vec3 low;
    vec3 high;
};
layout(scalar) readonly buffer Boxes { Box data[]; } boxes;  // The first one contains all others.
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

bool intersects(Ray ray, Box box) {
    const vec3 direction = mix(ray.direction, vec3(1.0e-9), lessThan(abs(ray.direction), vec3(1.0e-9)));
    const vec3 a = (box.low - ray.origin) / direction, b = (box.high - ray.origin) / direction;
    const vec3 near = min(a, b), far = max(a, b);
    return max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), min(far.z, ray.tMax));
}

// Whether a ray intersects a changed box before its hit, which is within two voxels of the hit group's surfels.
bool intersectsChangedBox(uint ray, uint packedHit) {
    Ray r = patchRay(ray);
    if (hitsGroup(packedHit)) {
        const vec3 toGroup = patchSurfels.data[groups.data[hitGroup(packedHit)].firstSurfel].position - r.origin;
        r.tMax = min(r.tMax, length(toGroup) + 3.5 * push.grid.voxelSize);
    }
    if (!intersects(r, boxes.data[0])) return false;
    for (uint i = 1u; i < boxes.data.length(); ++i)
        if (intersects(r, boxes.data[i])) return true;
    return false;
}

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rayCount) return;
    uint packedHit = previousHit(ray);
    if (packedHit != HIT_UNKNOWN && intersectsChangedBox(ray, packedHit)) packedHit = HIT_UNKNOWN;
    packedHits.data[ray] = packedHit;
    if (packedHit == HIT_UNKNOWN) atomicOr(flags.words[ray / 32u], 1u << (ray % 32u));
}
