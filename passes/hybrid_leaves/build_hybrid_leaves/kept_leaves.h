#pragma once

#include <vector>

#include "graph/memory_plan.h"
#include "passes/hybrid_leaves/hybrid_leaves.h"
#include "vulkan/commands.h"
#include "vulkan/kernel.h"

namespace voxray {

/// What an update of hybrid leaves takes over of the last build: all leaves beyond the region in which
/// surfaces have changed. Their numbers and places are new; what they hold is copied, list by list and grid
/// by grid.
///
///     remember()                                   after each build
///     begin(), counts(), lists(), bits(), cells()  in the order in which an update fills the new arrays
///     end()
class KeptLeaves {
 public:
    explicit KeptLeaves(ProgramOwner& owner);

    /// Describes what leaves are numbered by.
    void plan(MemoryPlan& plan, const SurfaceVoxels& voxels);
    /// After a build: what its leaves are numbered by, and the triangles of each.
    void remember(CommandStream& stream, const SurfaceVoxels& numbered, Buffer counts);
    /// Takes the last build's arrays out of `leaves`, all but the header. @param region a bit for each voxel
    /// that is built again.
    void begin(HybridLeaves& leaves, Buffer region);
    bool isActive() const { return bool(region_); }
    const Buffer& region() const { return region_; }
    /// Which voxels the last build's leaves are.
    const Buffer& occupancy() const { return occupancy_; }

    /// Completes `counts`, of all leaves, out of what was `counted` in the region; sets that to 0 where a
    /// leaf is kept. @return leaves that are not. Waits for the device.
    uint32_t counts(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& counted,
                    const Buffer& counts);
    /// Copies lists. @param counts of all leaves.
    void lists(CommandStream& stream, const HybridLeaves& leaves, const Buffer& counts);
    /// Copies the bits of grids; then, once these are numbered and all cells have values, the cells.
    void bits(CommandStream& stream, const HybridLeaves& leaves) const;
    void cells(CommandStream& stream, const HybridLeaves& leaves) const;
    /// Frees what was taken. The stream has finished.
    void end();

 private:
    /// What kept_arrays.glsl is told, of `count` items.
    std::vector<Binding> arrays(uint32_t count) const;

    Kernel counts_, lists_, bits_, cells_;
    Buffer occupancy_, rank_, previousCounts_;  ///< Of the last build, as its arrays:
    HybridLeaves previous_;
    Buffer region_, keptFrom_, gridFrom_;
};

}  // namespace voxray
