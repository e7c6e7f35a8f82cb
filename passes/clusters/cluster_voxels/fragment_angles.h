#pragma once

#include <memory>

#include "passes/common/triangle_walk/triangle_walk.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Angles of the fragments in each voxel to the axes: what of the paper's lists of fragments ties between
/// ways are decided by. Source: Cosin and Patow 2022, section 4.2, figure 7.
class FragmentAngles {
 public:
    struct Sums {
        Buffer angles;  ///< By voxel: sums of angles to +x, +y and +z, and the number of fragments.
        float unitsPerRadian = 0;
    };

    explicit FragmentAngles(ProgramOwner& owner);

    void plan(PassPlan& plan) { walk_->plan(plan); }
    /// Waits for the device.
    Sums measure(PassContext& context, const SurfaceVoxels& voxels);

 private:
    std::unique_ptr<TriangleWalk> walk_;
    std::unique_ptr<PassProgram> add_;
};

}  // namespace voxray
