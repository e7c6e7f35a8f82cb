#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "passes/clusters/gather_clusters/visible_points.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// The voxels for which light is gathered: all, or those in view by G-buffer or by sample points.
enum class GatherUpdate { All, Seen, SeenPoints };
template <>
struct EnumNames<GatherUpdate> {
    static constexpr std::array names{std::pair{GatherUpdate::All, "all"}, std::pair{GatherUpdate::Seen, "seen"},
                                      std::pair{GatherUpdate::SeenPoints, "seen_points"}};
};

/// Finds voxels that come into the camera's view, each once: those that lookups of irradiance read around
/// visible surfaces or, with GatherUpdate::SeenPoints, those found by VisiblePoints.
class VisibleVoxels {
 public:
    VisibleVoxels(ProgramOwner& owner, GatherUpdate update);

    struct NewVoxels {
        uint32_t voxelCount = 0;
        /// Number of elements of groups() that are at most 0, 1 ... steps to neighbors from these voxels.
        std::vector<uint32_t> groupCounts;
    };

    void plan(PassPlan& plan);
    /// Allocates the buffers. No voxel counts as found any more.
    void reset(PassContext& context, const SurfaceVoxels& voxels, const VoxelPatches& patches);
    /// @param gbuffer visible surfaces. @param reach distance in voxels along each axis that lookups around
    /// them read; both are unused with SeenPoints. @param steps of dilation. Waits for the device.
    NewVoxels find(PassContext& context, const GBuffer* gbuffer, const SurfaceVoxels& voxels,
                   const VoxelClusters& clusters, const VoxelPatches& patches, uint32_t reach, uint32_t steps) const;

    /// Result of the last find(): new voxels, and their unoccluded groups with neighbors.
    const Buffer& voxels() const { return newVoxels_; }
    const Buffer& groups() const { return listedGroups_; }

 private:
    void markLookups(PassContext& context, const GBuffer& gbuffer, const SurfaceVoxels& voxels, uint32_t reach) const;

    std::optional<VisiblePoints> points_;  ///< For GatherUpdate::SeenPoints.
    Kernel markVoxels_, listGroups_, dilate_;
    Buffer requestedVoxels_;  ///< Per voxel: bits as in mark_visible_voxels.comp.
    Buffer newVoxels_, listedGroups_, isListed_, count_;
};

}  // namespace voxray
