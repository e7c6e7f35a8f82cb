// One iteration of label propagation, which finds connected components: each group takes the least label of its
// neighbors in the same cluster. The result does not depend on the order of threads: labels converge to the least
// index of the groups of a component.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstCandidate { uint data[]; } firstCandidate;
layout(scalar) readonly buffer CandidatesRef { LargeUints candidates; };  // Neighbors; NO_GROUP: occluded.
readonly buffer ClusterOfVoxel { uint data[]; } clusterOfVoxel;
buffer Labels { uint data[]; } labels;
buffer Changed { uint count; } changed;
layout(push_constant) uniform Push { uint groupCount; } push;

void main() {
    const uint group = linearIndex();
    if (group >= push.groupCount) return;
    const uint cluster = clusterOfVoxel.data[groups.data[group].voxel];
    uint label = labels.data[labels.data[group]];
    for (uint i = firstCandidate.data[group]; i < firstCandidate.data[group + 1u]; ++i) {
        const uint neighbor = candidates.data[i];
        if (neighbor == NO_GROUP || clusterOfVoxel.data[groups.data[neighbor].voxel] != cluster) continue;
        label = min(label, labels.data[neighbor]);
    }
    if (label == labels.data[group]) return;
    labels.data[group] = label;
    atomicAdd(changed.count, 1u);
}
