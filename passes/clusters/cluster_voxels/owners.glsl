// By voxel: which cluster it belongs to, in the numbers that clusters have until empty ones are dropped: seeds first, then one for
// each voxel that may begin a cluster of its own.
#include "passes/clusters/cluster_voxels/neighbourhood.glsl"

layout(scalar) buffer Owners { uint data[]; } owners;
