#pragma once

#include <memory>

#include "passes/common/voxels/voxels.h"
#include "passes/cones/clipmap/clipmap_windows.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Light that arrives at surface voxels, laid out as in VoxelIrradiance.
struct SurfaceLight {
    const LargeBuffer& direct;
    const LargeBuffer& indirect;
    const Buffer& area;
    bool isNew;  ///< Whether it has changed since the pass ran last.

    /// Bindings of passes/cones/radiance/surface_radiance.glsl, besides those of the voxels.
    std::vector<Binding> bindings() const {
        return {{"DirectFluxRef", direct.ref()}, {"IndirectFluxRef", indirect.ref()}, {"voxelArea", area}};
    }
};

/// Storage of radiance voxels in one layout, filled from surface voxels and their light.
class RadianceStorage {
 public:
    virtual ~RadianceStorage() = default;
    /// Whether it stores windows around the camera, so that it is filled in each frame.
    virtual bool followsCamera() const { return false; }
    /// Describes memory. The grid of `radiance` is set; its unit and number of levels may be changed.
    /// @throws Error if the device lacks a feature.
    virtual void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) = 0;
    /// Uploads headers, clears textures.
    virtual void prepare(PassSetup&, RadianceVoxels&) {}
    /// Fills all levels. `emission`: 1 to add what surfaces emit, 0 not to.
    virtual void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
                     RadianceVoxels& radiance, float emission) = 0;
    /// Called after the last run(): frees scratch.
    virtual void finalize(CommandStream&, RadianceVoxels&) {}
};

/// Parameters of the layout svo_bricks; a pass adds schema() to its own with std::tuple_cat.
struct BrickParams {
    bool brickNeighbors = true;
    static constexpr auto schema() {
        return std::tuple{
            field("brick_neighbors", &BrickParams::brickNeighbors,
                  "Whether the 26 neighbors of each node that surfaces pass through get bricks. "
                  "Off, values that bricks share differ where one is missing, as in Arnebäck 2017, figure 28.")};
    }
};

std::unique_ptr<RadianceStorage> makeRadianceStorage(ProgramOwner& owner, RadianceLayout layout,
                                                     const ClipmapParams& clipmap, const BrickParams& bricks);

}  // namespace voxray
