#pragma once

#include <limits>

#include "passes/common/voxel_march/voxel_march.h"
#include "passes/hybrid_leaves/hybrid_leaves.h"
#include "trace/gpu_scene.h"
#include "trace/ray_tracer.h"

namespace voxray {

/// How a ray traverses leaves.
enum class HybridTraversal {
    Hierarchical,  ///< Skips empty space at all scales (VoxelTraversal::Bricks).
    VoxelByVoxel,  ///< From the root for each finest voxel, empty ones included (Seok 2021, figure 12).
};
template <>
struct EnumNames<HybridTraversal> {
    static constexpr std::array names{std::pair{HybridTraversal::Hierarchical, "hierarchical"},
                                      std::pair{HybridTraversal::VoxelByVoxel, "voxel_by_voxel"}};
};

/// Traces streams of rays through hybrid leaves. Hit::triangle is encoded as in
/// passes/hybrid_leaves/hybrid_types.h. A pass calls plan() from its own.
class HybridTracer final : public RayTracer {
 public:
    HybridTracer(ProgramOwner& owner, HybridTraversal traversal);

    /// Describes bricks, for HybridTraversal::Hierarchical; begin() builds the octree for the other. @throws
    /// Error as VoxelMarch::plan().
    void plan(MemoryPlan& plan, const SurfaceVoxels& voxels);
    std::string_view name() const override { return "hybrid"; }
    /// Sets voxels and leaves, and resets counts: before the first rays and after either has changed. All
    /// arguments must outlive the rays. Waits for the device where it builds the octree. @param maxWidth m:
    /// rays end where they are wider (HIT_IS_WIDE).
    void begin(CommandStream& stream, const GpuScene& scene, const SurfaceVoxels& voxels, const HybridLeaves& leaves,
               float maxWidth = std::numeric_limits<float>::infinity());
    /// For rays that start on surfaces or widen. @param starts a gpu::RayStart (hybrid_types.h) for each ray
    /// of the following calls, which it must outlive; null: rays without surface and width.
    void setStarts(const Buffer* starts) { starts_ = starts; }
    /// Of bricks or octree.
    size_t memoryBytes() const override { return march_.memoryBytes(); }
    /// Steps and node visits (PassContext::marchCounters), and ray-triangle tests, since begin(): 64 bits each.
    const Buffer& counts() const { return march_.counts(); }
    const Buffer& testCounts() const { return testCounts_; }

 private:
    /// Empty: begin() sets what has moved.
    void updateStructure(CommandStream&) override {}
    void trace(CommandStream& stream, Query query, const Buffer& rays, const Buffer& results, uint32_t count,
               Coherence coherence) override;

    VoxelMarch march_;
    Kernel closestHit_, occluded_;
    const GpuScene* scene_ = nullptr;
    const HybridLeaves* leaves_ = nullptr;
    gpu::VoxelGrid grid_{};
    float maxWidth_ = 0;
    const Buffer* starts_ = nullptr;
    Buffer testCounts_;
};

}  // namespace voxray
