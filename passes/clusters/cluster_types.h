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
    vec3 seedNormal;  // Unit: the normal of each of its voxels is within the angle limit of this one.
    vec3 albedo;      // Mean diffuse reflectance, weighted by area.
    uvec3 minVoxel;   // Bounding box, both included.
    uvec3 maxVoxel;
};

// A cluster's center while voxels are assigned, as in k-means.
struct ClusterSeed {
    vec3 center;       // In voxels.
    uint memberCount;  // 0: it has lost all its voxels and gets no more.
    vec3 normal;       // Unit.
};

VOXRAY_SHARED_END

#endif
