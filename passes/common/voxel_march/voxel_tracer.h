#pragma once

#include "passes/common/voxel_march/voxel_march.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// Traces streams of rays through voxels in place of triangles (Magalhães 2020, section 3.3.3.2). A hit's
/// `triangle` is the number of the surface voxel, its t is where the ray enters it, u and v are 0. Rays that
/// start in an occupied voxel hit it: offset their ends from surfaces
/// (shaders/voxel_march/surface_segment.glsl).
class VoxelTracer final : public RayTracer {
 public:
    VoxelTracer(ProgramOwner& owner, VoxelTraversal traversal, float epsilon = 0);

    /// As VoxelMarch::plan().
    void plan(MemoryPlan& plan, const SurfaceVoxels& voxels);
    std::string_view name() const override { return "voxels"; }
    /// As VoxelMarch::begin(): before the first rays and after the voxels have changed.
    void begin(CommandStream& stream, const SurfaceVoxels& voxels) {
        march_.begin(stream, voxels);
        grid_ = voxels.grid;
    }
    size_t memoryBytes() const override { return march_.memoryBytes(); }
    const VoxelMarch& march() const { return march_; }

 private:
    /// Empty: begin() sets what has moved.
    void updateStructure(CommandStream&) override {}
    void trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
               Coherence coherence) override;

    VoxelMarch march_;
    Kernel closestHit_, occluded_;
    gpu::VoxelGrid grid_{};
};

}  // namespace voxray
