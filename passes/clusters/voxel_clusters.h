#pragma once

#include "graph/pass.h"
#include "passes/clusters/cluster_types.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Clusters of adjacent surface voxels of like normals (cluster_voxels).
struct VoxelClusters : Resource {
    std::string indexedBy() const override { return "voxels"; }

    uint32_t count = 0;     ///< Number of clusters; known once the pass has run.
    Buffer clusters;        ///< gpu::VoxelCluster each, in the order of their seeds.
    Buffer clusterOfVoxel;  ///< Cluster of each voxel, or NO_CLUSTER.
    Buffer coordinates;     ///< Per voxel: three uints.

    std::vector<Elements> elements() const override { return {{&coordinates, Elements::Type::Uint32, 3}}; }
};

}  // namespace voxray
