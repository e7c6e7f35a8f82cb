// Writes the target of each ray: a face of a cluster component or, closer than nearDistance, a patch. NO_TARGET if the
// hit group sends no light, because it has no patch at the face or its voxel is in no cluster.
#include "passes/clusters/cluster_visibility/packed_hit.glsl"
#include "passes/clusters/visibility_list_types.h"
#include "passes/clusters/group_patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer PackedHits { uint data[]; } packedHits;
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer Components { ClusterComponent data[]; } components;
readonly buffer ComponentOfGroup { uint data[]; } componentOfGroup;
layout(scalar) writeonly buffer Targets { uint data[]; } targets;
buffer LostRays { uint counts[2]; } lostRays;  // Numbers of rays with HIT_NOTHING and with HIT_NO_GROUP.
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout listLayout;
    uint rays;
} push;

uint targetOf(uint packedHit) {
    const uint group = hitGroup(packedHit), face = hitFace(packedHit), component = componentOfGroup.data[group];
    if (component == NO_COMPONENT || face == NO_FACE || !hasPatch(groups.data[group], face)) return NO_TARGET;
    return isNear(packedHit) ? push.listLayout.firstPatchTarget + patchIndex(groups.data[group], face)
                             : componentFaceIndex(components.data[component], face);
}

void main() {
    const uint ray = linearIndex();
    if (ray >= push.rays) return;
    const uint packedHit = packedHits.data[ray];
    if (packedHit == HIT_NOTHING) atomicAdd(lostRays.counts[0], 1u);
    if (packedHit == HIT_NO_GROUP) atomicAdd(lostRays.counts[1], 1u);
    targets.data[ray] = hitsGroup(packedHit) ? targetOf(packedHit) : NO_TARGET;
}
