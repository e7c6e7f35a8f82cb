#pragma once

#include <cstdint>
#include <functional>

#include "graph/pass.h"

namespace voxray {

/// Rays from points round voxels, those of a batch of voxels at a time. GLSL:
/// passes/clusters/voxel_points.glsl and point_rays.glsl.
class PointRays {
 public:
    struct Batch {
        uint32_t firstVoxel;
        uint32_t voxels;
    };

    /// @param points round each voxel.
    explicit PointRays(uint32_t points) : points_(points) {}

    void plan(PassPlan& plan);
    /// @param aim fills rays(), those of a voxel one after another. @param use reads them and occluded().
    void trace(PassContext& context, uint32_t voxels, const std::function<void(const Batch&)>& aim,
               const std::function<void(const Batch&)>& use) const;

    const Buffer& rays() const { return rays_; }
    const Buffer& occluded() const { return occluded_; }

 private:
    uint32_t points_;
    Buffer rays_, occluded_;  ///< Scratch.
};

}  // namespace voxray
