#pragma once

#include <limits>

#include "passes/common/voxel_march/voxel_march.h"
#include "passes/hybrid_leaves/hybrid_leaves.h"
#include "trace/gpu_scene.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// How a ray gets from leaf to leaf.
enum class HybridWalk {
    Hierarchical,  ///< Past empty space of all sizes (VoxelWalk::Bricks).
    VoxelByVoxel,  ///< From the root for each finest voxel, empty ones too (Seok 2021, figure 12).
};
template <>
struct EnumNames<HybridWalk> {
    static constexpr std::array names{std::pair{HybridWalk::Hierarchical, "hierarchical"},
                                      std::pair{HybridWalk::VoxelByVoxel, "voxel_by_voxel"}};
};

/// Streams of rays through hybrid leaves, with the interface of rays through triangles. A hit's `triangle`
/// may be more than a triangle's number: passes/hybrid_leaves/hybrid_types.h. A pass calls plan() in its
/// own.
class HybridTracer final : public RayTracer {
 public:
    HybridTracer(ProgramOwner& owner, HybridWalk walk);

    /// Describes what a walk takes besides voxels and leaves: bricks; an octree is made by begin(). @throws
    /// Error as VoxelMarch::plan().
    void plan(MemoryPlan& plan, const SurfaceVoxels& voxels);
    std::string_view name() const override { return "hybrid"; }
    /// Takes over voxels and leaves, before the first rays and where either has changed, and sets the counts
    /// to 0. All must outlive the walks. Waits for the device where it builds the octree. @param widest m:
    /// rays end where they have become wider (HIT_IS_WIDE).
    void begin(CommandStream& stream, const GpuScene& scene, const SurfaceVoxels& voxels,
               const HybridLeaves& leaves, float widest = std::numeric_limits<float>::infinity());
    /// closestHit() for rays that leave surfaces or widen. @param starts a RayStart
    /// (passes/hybrid_leaves/hybrid_types.h) for each ray.
    void closestFrom(CommandStream& stream, const Buffer& rays, const Buffer& starts, const Buffer& hits,
                     uint32_t count);
    /// What the rays of occluded() and closestHit() leave, a RayStart each. @param starts must outlive them;
    /// null: bare rays.
    void setStarts(const Buffer* starts) { starts_ = starts; }
    /// Of bricks or octree.
    size_t memoryBytes() const override { return march_.memoryBytes(); }
    /// Steps and visits of nodes (PassContext::voxelCounts), and tests of triangles, since begin(): 64 bits
    /// each.
    const Buffer& counts() const { return march_.counts(); }
    const Buffer& testCounts() const { return testCounts_; }

 private:
    /// Nothing: begin() takes over what has moved.
    void updateStructure(CommandStream&) override {}
    void trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
               Coherence coherence) override;
    void dispatch(CommandStream& stream, const Program& program, VkDeviceAddress rays, VkDeviceAddress starts,
                  VkDeviceAddress results, uint32_t count);

    VoxelMarch march_;
    Kernel closestHit_, occluded_;
    const GpuScene* scene_ = nullptr;
    const HybridLeaves* leaves_ = nullptr;
    gpu::VoxelGrid grid_{};
    float widest_ = 0;
    const Buffer* starts_ = nullptr;
    Buffer testCounts_;
};

}  // namespace voxray
