#pragma once

#include <memory>
#include <vector>

#include "passes/common/voxels.h"

namespace voxray {

/// What a method does with each voxel that it finds: mark it in the occupancy, or add what the surface
/// carries to its sums (sums_layout.h).
struct VoxelizeStep {
    bool mark;
    const Buffer* target;  ///< Occupancy to mark in, or the address of sums to add to.
    float emissionScale;   ///< One over the scene's largest emission; 0: nothing emits.
};

/// A way of finding the voxels that triangles meet and how much of a triangle each one holds.
class VoxelizeMethod {
 public:
    virtual ~VoxelizeMethod() = default;
    /// Checks the device and reserves memory. @throws Error naming the feature that is missing.
    virtual void plan(PassPlan& plan, const SurfaceVoxels& voxels) = 0;
    virtual void prepare(PassSetup& setup) = 0;
    virtual void run(PassContext& context, const SurfaceVoxels& voxels, const VoxelizeStep& step) = 0;
};

/// Rasterises along all three axes, `samples` squared points a voxel.
std::unique_ptr<VoxelizeMethod> makeThreeAxis(uint32_t samples);
/// Rasterises each triangle once, conservatively, along the axis that it faces most.
std::unique_ptr<VoxelizeMethod> makeDominantAxis();
/// Tests triangles against voxels' boxes in a compute shader.
std::unique_ptr<VoxelizeMethod> makeExact();

/// What visits of voxels read and write, for programs that include voxel_sums.glsl.
std::vector<Binding> stepBindings(const PassContext& context, const SurfaceVoxels& voxels,
                                  const VoxelizeStep& step, std::initializer_list<Binding> more = {});

/// Preprocessor definitions of a step's shaders.
inline Defines stepDefines(bool mark) {
    return mark ? Defines{{"MARK", "1"}} : Defines{};
}

}  // namespace voxray
