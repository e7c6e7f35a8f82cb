#pragma once

#include <memory>

#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Sums of the angles between the axes and the normals of a voxel's fragments: all that deciding ties needs
/// of the paper's lists of fragments. Source: Cosin and Patow 2022, section 4.2, figure 7.
class FragmentAngles {
 public:
    struct Sums {
        Buffer angles;  ///< By voxel: sums of angles to +x, +y and +z, and the number of fragments.
        float unitsPerRadian = 0;
    };

    explicit FragmentAngles(ProgramOwner& owner);

    void plan(PassPlan& plan) { voxelizer_->plan(plan); }
    /// Waits for the device.
    Sums measure(PassContext& context, const SurfaceVoxels& voxels);

 private:
    std::unique_ptr<TriangleVoxelizer> voxelizer_;
    std::unique_ptr<PassProgram> accumulate_;
};

}  // namespace voxray
