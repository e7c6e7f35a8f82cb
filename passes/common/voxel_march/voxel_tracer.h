#pragma once

#include "passes/common/voxel_march/voxel_march.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// Streams of rays through voxels, with the interface of rays through triangles: what takes the one can take
/// the other, for comparison (Magalhães 2020, section 3.3.3.2). A hit's `triangle` is the number of the
/// surface voxel, its t is where the ray enters it, u and v are 0. Rays that start in an occupied voxel hit
/// it: whoever starts them at a surface moves their ends out of its voxels
/// (shaders/voxel_march/surface_segment.glsl).
class VoxelTracer final : public RayTracer {
 public:
    VoxelTracer(ProgramOwner& owner, VoxelTraversal walk, float epsilon = 0);

    /// As VoxelMarch::plan().
    void plan(MemoryPlan& plan, const SurfaceVoxels& voxels);
    std::string_view name() const override { return "voxels"; }
    /// Takes over the voxels, as VoxelMarch::begin(); before the first rays and where the voxels have
    /// changed.
    void begin(CommandStream& stream, const SurfaceVoxels& voxels) {
        march_.begin(stream, voxels);
        grid_ = voxels.grid;
    }
    size_t memoryBytes() const override { return march_.memoryBytes(); }
    const VoxelMarch& march() const { return march_; }

 private:
    /// Nothing: begin() takes over what has moved.
    void updateStructure(CommandStream&) override {}
    void trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
               Coherence coherence) override;

    VoxelMarch march_;
    Kernel closestHit_, occluded_;
    gpu::VoxelGrid grid_{};
};

}  // namespace voxray
