#pragma once

#include <memory>
#include <vector>

#include "passes/common/triangle_walk/voxel_region.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// What a method does with each voxel that it finds: mark it in the occupancy, or add what the surface
/// carries to its sums (sums_layout.h), where it is marked.
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
    /// Chooses what run() works on: `triangles`, those that may have a part in the region. All of the
    /// region's voxels are found; others may be.
    virtual void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                        const std::vector<uint32_t>& triangles) = 0;
    virtual void run(PassContext& context, const SurfaceVoxels& voxels, const VoxelizeStep& step) = 0;
    /// Frees what select() took, once the stream has finished.
    virtual void release() = 0;
};

/// A method that draws triangles: vertex shaders number the corners of `drawnTriangles`.
class RasterMethod : public VoxelizeMethod {
 public:
    void plan(PassPlan& plan, const SurfaceVoxels& voxels) override;
    void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                const std::vector<uint32_t>& triangles) override;
    void release() override { drawn_ = {}; }

 protected:
    std::vector<Binding> bindings(const PassContext& context, const SurfaceVoxels& voxels,
                                  const VoxelizeStep& step) const;
    uint32_t corners() const { return corners_; }

 private:
    Buffer drawn_;
    uint32_t corners_ = 0;
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
