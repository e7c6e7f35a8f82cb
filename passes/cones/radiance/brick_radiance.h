#pragma once

#include "passes/common/octree/brick_octree.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Radiance voxels of layout svo_bricks (passes/cones/radiance/radiance_svo_bricks.glsl): memory of the
/// bricks, and their filter from the leaves up (Arnebäck 2017, sections 3.2.3 and 3.2.4). `radiance.storage`
/// holds their scale and their values.
class BrickRadiance {
 public:
    explicit BrickRadiance(ProgramOwner& owner);

    /// Describes memory except nodes and bricks. Reads layout and grid of `radiance`, sets its unit.
    static void plan(PassPlan& plan, RadianceVoxels& radiance);
    /// After a change of the octree: allocates its bricks, and uploads the addresses of bricks and nodes.
    void setOctree(CommandStream& stream, const BrickOctree& octree, RadianceVoxels& radiance) const;
    /// Given the bricks of leaves: makes values that adjacent bricks share equal, then applies the Gaussian
    /// filter level by level.
    void filter(CommandStream& stream, const BrickOctree& octree, const RadianceVoxels& radiance) const;

 private:
    /// @param weight of the sum of two bricks' values: 1, or 1/2 for their mean.
    void transfer(CommandStream& stream, const RadianceVoxels& radiance, const gpu::LevelNodes& nodes,
                  float weight) const;

    Kernel transfer_, filter_;
};

}  // namespace voxray
