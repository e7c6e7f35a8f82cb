// Clusters of surface voxels, shared by C++ (passes/clusters/voxel_clusters.h) and GLSL.
#ifndef VOXRAY_SHARED_CLUSTER_TYPES_H
#define VOXRAY_SHARED_CLUSTER_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

#define NO_CLUSTER 0xffffffffu

// Adjacent surface voxels of similar normals.
struct VoxelCluster {
    vec3 seedNormal;   // Unit: the normals of all its voxels are within the angle limit of it.
    uint memberCount;  // Number of its voxels.
};

// The center of a cluster while voxels are assigned to it, as in k-means.
struct ClusterSeed {
    vec3 center;       // In voxels.
    uint memberCount;  // 0: it has lost all voxels and is not used any more.
    vec3 normal;       // Unit.
};

VOXRAY_SHARED_END

#endif
