// The targets of rays, out of what they met: a face of a cluster's part or, near by, the patch itself. None where there is no patch, and
// for a side without a cluster, which sends nothing. A thread takes a ray.
#include "passes/clusters/cluster_visibility/met.glsl"
#include "passes/clusters/seen_types.h"
#include "passes/clusters/side_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Met { uint data[]; } met;
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer OfSide { uint data[]; } ofSide;  // Parts of clusters.
layout(scalar) writeonly buffer Targets { uint data[]; } targets;
buffer Missed { uint counts[2]; } missed;  // Rays that met nothing, and hits without a side.
layout(push_constant, scalar) uniform Push {
    SeenLayout lists;
    uint rays;
} push;

uint targetOf(uint word) {
    const uint side = sideOf(word), face = faceMet(word), part = ofSide.data[side];
    if (part == NO_PART || face == NO_FACE || !hasPatch(sides.data[side], face)) return NO_TARGET;
    return isNear(word) ? push.lists.sideTargets + patchAt(sides.data[side], face) : 6u * part + face;
}

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rays) return;
    const uint word = met.data[ray];
    if (word == MET_NOTHING) atomicAdd(missed.counts[0], 1u);
    if (word == MET_NO_SIDE) atomicAdd(missed.counts[1], 1u);
    targets.data[ray] = isSide(word) ? targetOf(word) : NO_TARGET;
}
