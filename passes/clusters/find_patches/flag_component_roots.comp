// Sets a bit for the root of each component: a group whose label is its own index and whose voxel has a cluster.
#include "passes/clusters/cluster_types.h"
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer ClusterOfVoxel { uint data[]; } clusterOfVoxel;
readonly buffer Labels { uint data[]; } labels;
writeonly buffer Flags { uint words[]; } flags;
layout(push_constant) uniform Push { uint groupCount; } push;

void main() {
    const uint word = linearIndex();
    if (32u * word >= push.groupCount) return;
    uint bits = 0u;
    for (uint i = 0u; i < 32u && 32u * word + i < push.groupCount; ++i) {
        const uint group = 32u * word + i;
        if (labels.data[group] == group && clusterOfVoxel.data[groups.data[group].voxel] != NO_CLUSTER) bits |= 1u << i;
    }
    flags.words[word] = bits;
}
