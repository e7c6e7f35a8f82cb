#pragma once

#include <memory>

#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Sums the angles between the axes and the normals of each voxel's fragments (parts of triangles). They
/// replace the paper's lists of fragments. Source: Cosin and Patow 2022, section 4.2 and figure 7.
class FragmentAngleSums {
 public:
    struct Sums {
        Buffer angles;              ///< Per voxel: sums of angles to +x, +y and +z, and the number of fragments.
        float fixedPointScale = 0;  ///< Units of these sums in a radian.
    };

    explicit FragmentAngleSums(ProgramOwner& owner);

    void plan(PassPlan& plan) { voxelizer_->plan(plan); }
    /// Waits for the device.
    Sums measure(PassContext& context, const SurfaceVoxels& voxels);

 private:
    std::unique_ptr<TriangleVoxelizer> voxelizer_;
    std::unique_ptr<PassProgram> accumulate_;
};

}  // namespace voxray
