// Clusters of surface voxels, shared by C++ (passes/clusters/voxel_clusters.h) and GLSL.
#ifndef VOXRAY_SHARED_CLUSTER_TYPES_H
#define VOXRAY_SHARED_CLUSTER_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

#define NO_CLUSTER 0xffffffffu

// Adjacent surface voxels of like normals.
struct VoxelCluster {
    vec3 position;  // Mean of its voxels' centers, m.
    uint firstMember;
    vec3 normal;  // Unit: the mean normal of its voxels.
    uint memberCount;
    vec3 seedNormal;  // Unit: the normals of all its voxels are within the angle limit of it.
    vec3 albedo;      // Mean diffuse reflectance, weighted by area.
    uvec3 minVoxel;   // Bounding box, inclusive.
    uvec3 maxVoxel;
};

// The center of a cluster while voxels are assigned to it, as in k-means.
struct ClusterSeed {
    vec3 center;       // In voxels.
    uint memberCount;  // 0: it has lost all voxels and is not used any more.
    vec3 normal;       // Unit.
};

VOXRAY_SHARED_END

#endif
