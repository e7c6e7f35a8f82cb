// What rays met before surfaces changed, where that still holds; flags those that are to be traced again: of patches in voxels that have
// changed, that met something there, or that pass a changed box on their way. A thread takes a ray.
#include "passes/clusters/cluster_visibility/patch_ray.glsl"
#include "shaders/compute/large_buffer.glsl"
layout(local_size_x = 64) in;

struct Box {
    vec3 low;
    vec3 high;
};
layout(scalar) readonly buffer Boxes { Box data[]; } boxes;  // The first one holds all others.
layout(scalar) readonly buffer Before { LargeUints data[]; } before;  // What rays met, by chunk, with sides as they were numbered.
readonly buffer NewSides { uint data[]; } newSides;
readonly buffer BeganAt { uint data[]; } beganAt;
writeonly buffer Met { uint data[]; } met;
buffer Flags { uint words[]; } flags;  // 0 before.

uint metBefore(uint ray) {
    const uint patch_ = push.firstPatch + ray / push.lists.raysPerPatch, side = faces.data[patch_] / 6u;
    if (beganAt.data[side] == NO_SIDE) return MET_UNKNOWN;
    const uint number = beganAt.data[side] + patch_ - sides.data[side].firstPatch;
    const uint word = before.data[number / push.lists.patchesPerChunk]
                          .data[number % push.lists.patchesPerChunk * push.lists.raysPerPatch + ray % push.lists.raysPerPatch];
    // A surface without a side may be anywhere
    if (!isSide(word)) return word == MET_NO_SIDE ? MET_UNKNOWN : word;
    const uint now = newSides.data[sideOf(word)];
    return now == NO_SIDE ? MET_UNKNOWN : withSide(word, now);
}

bool meets(Ray ray, Box box) {
    const vec3 direction = mix(ray.direction, vec3(1.0e-9), lessThan(abs(ray.direction), vec3(1.0e-9)));
    const vec3 a = (box.low - ray.origin) / direction, b = (box.high - ray.origin) / direction;
    const vec3 near = min(a, b), far = max(a, b);
    return max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), min(far.z, ray.tMax));
}

// Whether a ray passes a changed box before it ends: within two voxels, along each axis, of the surfels of the side that it met.
bool passesChange(uint ray, uint word) {
    Ray r = patchRay(ray);
    if (isSide(word)) {
        const vec3 away = patchSurfels.data[sides.data[sideOf(word)].firstSurfel].position - r.origin;
        r.tMax = min(r.tMax, length(away) + 3.5 * push.grid.voxelSize);
    }
    if (!meets(r, boxes.data[0])) return false;
    for (uint i = 1u; i < boxes.data.length(); ++i)
        if (meets(r, boxes.data[i])) return true;
    return false;
}

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rayCount) return;
    uint word = metBefore(ray);
    if (word != MET_UNKNOWN && passesChange(ray, word)) word = MET_UNKNOWN;
    met.data[ray] = word;
    if (word == MET_UNKNOWN) atomicOr(flags.words[ray / 32u], 1u << (ray % 32u));
}
