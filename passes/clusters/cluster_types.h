// Clusters of surface voxels, shared by C++ (passes/clusters/voxel_clusters.h) and GLSL.
#ifndef VOXRAY_SHARED_CLUSTER_TYPES_H
#define VOXRAY_SHARED_CLUSTER_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

#define NO_CLUSTER 0xffffffffu

// Surface voxels that lie near each other and look the same way.
struct VoxelCluster {
    vec3 position;  // Mean of its voxels' centers, m.
    uint firstMember;
    vec3 normal;  // Unit: the mean normal of its voxels.
    uint members;
    vec3 axis;    // Unit: each of its voxels' normals is within the angle limit of this one.
    vec3 albedo;  // Mean diffuse reflectance, by area.
    uvec3 first;  // The first and the last voxel of its box.
    uvec3 last;
};

// What grows into a cluster, while voxels choose theirs.
struct ClusterSeed {
    vec3 center;   // In voxels.
    uint members;  // 0: it has lost all its voxels and gets no more.
    vec3 normal;   // Unit.
};

VOXRAY_SHARED_END

#endif
