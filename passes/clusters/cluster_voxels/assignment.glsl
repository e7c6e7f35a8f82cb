// Cluster of each voxel: the number of a seed, seedCount + voxel for a cluster whose seed is a voxel that was
// unassigned, or NO_CLUSTER.
#include "passes/clusters/cluster_voxels/neighborhood.glsl"

layout(scalar) buffer Assignment { uint data[]; } assignment;
