#pragma once

#include <cstdint>
#include <functional>

#include "graph/pass.h"

namespace voxray {

/// Traces visibility rays from a fixed set of points around each voxel, in batches of voxels. GLSL:
/// passes/clusters/voxel_points.glsl and voxel_point_rays.glsl.
class VoxelPointRays {
 public:
    struct Batch {
        uint32_t firstVoxel;
        uint32_t voxels;
    };

    explicit VoxelPointRays(uint32_t pointsPerVoxel) : pointsPerVoxel_(pointsPerVoxel) {}

    void plan(PassPlan& plan);
    /// @param generate fills rays(), ordered by voxel and point. @param use reads rays() and occluded().
    void trace(PassContext& context, uint32_t voxels, const std::function<void(const Batch&)>& generate,
               const std::function<void(const Batch&)>& use) const;

    const Buffer& rays() const { return rays_; }
    const Buffer& occluded() const { return occluded_; }

 private:
    uint32_t pointsPerVoxel_;
    Buffer rays_, occluded_;  ///< Scratch.
};

}  // namespace voxray
