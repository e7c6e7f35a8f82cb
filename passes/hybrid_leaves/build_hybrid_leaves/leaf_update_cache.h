#pragma once

#include <vector>

#include "graph/memory_plan.h"
#include "passes/hybrid_leaves/hybrid_leaves.h"
#include "vulkan/commands.h"
#include "vulkan/kernel.h"

namespace voxray {

/// Copies unchanged leaves from the previous build when hybrid leaves are updated: all leaves outside the
/// region in which surfaces have moved. Leaves and their arrays get new indices; lists and grids are copied
/// one by one.
///
///     store()                                     after each build
///     beginUpdate(), mergeCounts(), copyLists(),
///     copyGridBits(), copyCells()                 in this order, as an update fills the new arrays
///     endUpdate()
class LeafUpdateCache {
 public:
    explicit LeafUpdateCache(ProgramOwner& owner);

    /// Describes the buffers of store().
    void plan(MemoryPlan& plan, const SurfaceVoxels& voxels);
    /// Stores the voxels that a build's leaves are indexed by, and the leaves' triangle counts.
    void store(CommandStream& stream, const SurfaceVoxels& voxels, Buffer counts);
    /// Moves the previous build's arrays, all but the header, out of `leaves`. @param region a bit for each
    /// voxel that is rebuilt.
    void beginUpdate(HybridLeaves& leaves, Buffer region);
    bool isActive() const { return bool(region_); }
    const Buffer& region() const { return region_; }
    /// Of the previous build's voxels.
    const Buffer& occupancy() const { return occupancy_; }

    /// Merges previous counts and `rebuiltCounts` into `counts`, and sets those to 0 for unchanged leaves.
    /// @return the number of rebuilt leaves. Waits for the device.
    uint32_t mergeCounts(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& rebuiltCounts,
                         const Buffer& counts);
    /// @param counts of all leaves.
    void copyLists(CommandStream& stream, const HybridLeaves& leaves, const Buffer& counts);
    /// Call copyCells() once occupancy is ranked and all cells have values.
    void copyGridBits(CommandStream& stream, const HybridLeaves& leaves) const;
    void copyCells(CommandStream& stream, const HybridLeaves& leaves) const;
    /// Frees the previous arrays. The stream must have finished.
    void endUpdate();

 private:
    /// Push constants of previous_arrays.glsl.
    std::vector<Binding> previousArrays(uint32_t count) const;

    Kernel mergeCounts_, copyLists_, copyGridBits_, copyCells_;
    Buffer occupancy_, rank_, previousCounts_;  ///< Of the previous build.
    HybridLeaves previous_;
    Buffer region_, previousLeaf_, previousGrid_;
};

}  // namespace voxray
