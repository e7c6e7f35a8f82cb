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

/// Which voxels light is gathered for.
enum class GatherUpdate { All, Seen, SeenPoints };
template <>
struct EnumNames<GatherUpdate> {
    static constexpr std::array names{std::pair{GatherUpdate::All, "all"},
                                      std::pair{GatherUpdate::Seen, "seen"},
                                      std::pair{GatherUpdate::SeenPoints, "seen_points"}};
};

/// Voxels that come into the camera's view: those that lookups of irradiance read at what the camera sees, or
/// VisiblePoints (Cosin and Patow 2022, section 4.4). Each is found once.
class VisibleVoxels {
 public:
    VisibleVoxels(ProgramOwner& owner, GatherUpdate update);

    struct NewVoxels {
        uint32_t voxelCount = 0;
        /// How many of groups() are within 0, 1 ... steps to neighbours from these voxels.
        std::vector<uint32_t> groupCounts;
    };

    void plan(PassPlan& plan);
    /// Forgets what was seen. Makes the buffers.
    void reset(PassContext& context, const SurfaceVoxels& voxels, const VoxelPatches& patches);
    /// @param gbuffer, @param reach what the camera sees, and voxels along each axis that lookups read around
    /// it; unused by the test of points. @param steps to neighbours. Waits for the device.
    NewVoxels find(PassContext& context, const GBuffer* gbuffer, const SurfaceVoxels& voxels,
                   const VoxelClusters& clusters, const VoxelPatches& patches, uint32_t reach,
                   uint32_t steps) const;

    /// Voxels, and unoccluded groups of them and their neighbours, that find() found last.
    const Buffer& voxels() const { return newVoxels_; }
    const Buffer& groups() const { return listedGroups_; }

 private:
    void markLookups(PassContext& context, const GBuffer& gbuffer, const SurfaceVoxels& voxels,
                     uint32_t reach) const;

    std::optional<VisiblePoints> points_;  ///< For the test of points.
    Kernel markVoxels_, listGroups_, dilate_;
    Buffer requestedVoxels_;  ///< By voxel: bits as in mark_visible_voxels.comp.
    Buffer newVoxels_, listedGroups_, isListed_, count_;
};

}  // namespace voxray
