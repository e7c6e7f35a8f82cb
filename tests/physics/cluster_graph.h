#pragma once

#include <string>
#include <vector>

#include "passes/common/clusters/voxel_patches.h"
#include "tests/physics/voxels_read.h"

/// A graph whose voxels are lit through clusters, and what its tests read of it.
namespace voxray::test {

inline const std::string kDirect = "rays_per_light: 262144, bounces: 0";

inline std::vector<std::string> clusterGraph(const std::string& inject, const std::string& cluster,
                                             const std::string& visibility, const std::string& bounces,
                                             const std::string& gather,
                                             const std::string& resolution = "24") {
    return {"gbuffer",
            "voxelize, resolution: " + resolution,
            "place_surfels",
            "inject_light_rays, " + inject,
            "cluster_voxels, " + cluster,
            "find_patches",
            "cluster_visibility, " + visibility,
            "inject_clusters, bounces: " + bounces,
            "gather_clusters, " + gather,
            "gather_irradiance"};
}

/// Sides that split the surfaces of a chain's voxels.
inline std::vector<gpu::SurfaceSide> readSides(Chain& chain) {
    return chain.read<gpu::SurfaceSide>(chain.graph().resource<VoxelPatches>("patches")->sides);
}

}  // namespace voxray::test
