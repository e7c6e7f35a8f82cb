// By voxel: its cluster, numbered with empty ones: a seed, or seedCount + voxel for a cluster that a voxel began; or NO_CLUSTER.
#include "passes/clusters/cluster_voxels/neighbourhood.glsl"

layout(scalar) buffer Assignment { uint data[]; } assignment;
