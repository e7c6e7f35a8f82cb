#pragma once

#include "graph/pass.h"
#include "passes/clusters/cluster_types.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Surface voxels in groups that lie near each other and look the same way (cluster_voxels).
struct VoxelClusters : Resource {
    std::string basisPort() const override { return "voxels"; }

    uint32_t count = 0;  ///< Clusters; known once the pass has run.
    Buffer clusters;     ///< gpu::VoxelCluster each, in the order of the seeds that they grew from.
    Buffer ofVoxel;      ///< By voxel number: its cluster, or NO_CLUSTER.
    Buffer members;      ///< Voxel numbers, those of each cluster together and ascending.
    Buffer coordinates;  ///< By voxel number: three uints.
};

}  // namespace voxray
