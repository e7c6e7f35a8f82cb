#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "passes/clusters/gather_clusters/seen_points.h"
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

/// Which voxels come into the camera's view: those that a lookup at what it sees reads, or those that it sees
/// one of 12 points round (Cosin and Patow 2022, section 4.4).
class SeenVoxels {
 public:
    SeenVoxels(ProgramOwner& owner, GatherUpdate update);

    /// How many voxels were not seen before, and how many sides they reach.
    struct Found {
        uint32_t voxelCount = 0;
        /// The first so many of sides() are within 0, 1 ... steps from neighbour to neighbour.
        std::vector<uint32_t> sidesWithin;
    };

    void plan(PassPlan& plan);
    /// Nothing has been seen. Makes the buffers.
    void reset(PassContext& context, const SurfaceVoxels& voxels, const VoxelPatches& patches);
    /// @param gbuffer what the camera sees, and @param reach how many voxels along each axis count as round
    /// it: null and any for the test by points. @param steps from neighbour to neighbour. Waits for the
    /// device.
    Found find(PassContext& context, const GBuffer* gbuffer, const SurfaceVoxels& voxels,
               const VoxelClusters& clusters, const VoxelPatches& patches, uint32_t reach,
               uint32_t steps) const;

    /// Numbers of voxels, and of open sides, that find() has found last.
    const Buffer& voxels() const { return found_; }
    const Buffer& sides() const { return listed_; }

 private:
    /// Those that a lookup reads.
    void mark(PassContext& context, const GBuffer& gbuffer, const SurfaceVoxels& voxels,
              uint32_t reach) const;

    std::optional<SeenPoints> points_;  ///< For the test by points.
    Kernel mark_, listSides_, spread_;
    Buffer asked_;  ///< By voxel, bits: it was seen; a lookup has marked all those round it.
    Buffer found_, listed_, reached_, count_;
};

}  // namespace voxray
