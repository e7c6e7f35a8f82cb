#pragma once

#include "passes/common/octree/brick_octree.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Radiance voxels of layout svo_bricks (passes/cones/radiance/radiance_svo_bricks.glsl): memory of the
/// bricks, and their levels from the leaves up, as in Arnebäck 2017, sections 3.2.3 and 3.2.4.
/// `radiance.storage` holds their scale and their values.
class BrickRadiance {
 public:
    explicit BrickRadiance(ProgramOwner& owner);

    /// Describes memory but for nodes and bricks; layout and grid of `radiance` are there, its unit is set.
    static void plan(PassPlan& plan, RadianceVoxels& radiance);
    /// Where the octree changed: makes room for its bricks, and leads the shaders to them and to its nodes.
    void follow(CommandStream& stream, const BrickOctree& octree, RadianceVoxels& radiance) const;
    /// All that leaves' bricks lead to: values that adjacent bricks share made equal, then level by level the
    /// parts of the Gaussian filter. Leaves' bricks have their values.
    void filter(CommandStream& stream, const BrickOctree& octree, const RadianceVoxels& radiance) const;

 private:
    /// @param part of the sum of two bricks' values: 1, or 1/2 for their mean.
    void transfer(CommandStream& stream, const RadianceVoxels& radiance, const gpu::LevelNodes& nodes,
                  float part) const;

    Kernel transfer_, filter_;
};

}  // namespace voxray
