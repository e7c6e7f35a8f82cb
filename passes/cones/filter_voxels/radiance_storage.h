#pragma once

#include <memory>

#include "passes/common/voxels/voxels.h"
#include "passes/cones/clipmap/clipmap_windows.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Light that surface voxels reflect, laid out as in VoxelIrradiance.
struct SurfaceLight {
    const LargeBuffer& direct;
    const LargeBuffer& indirect;
    const Buffer& area;
    bool isNew;  ///< Whether it has been measured again since the pass ran last.

    /// Of passes/cones/radiance/surface_radiance.glsl, besides the voxels'.
    std::vector<Binding> bindings() const {
        return {{"DirectFluxAt", direct.at()}, {"IndirectFluxAt", indirect.at()}, {"voxelArea", area}};
    }
};

/// A way of storing radiance voxels: makes them of surface voxels and the light that they catch.
class RadianceStorage {
 public:
    virtual ~RadianceStorage() = default;
    /// Whether it holds what is near the camera alone, so that it is filled in each frame.
    virtual bool followsCamera() const { return false; }
    /// Describes memory. `radiance` has its grid; the unit and the number of levels may be set to others.
    /// @throws Error for what this device can't do.
    virtual void plan(PassPlan& plan, const SurfaceVoxels& voxels, RadianceVoxels& radiance) = 0;
    /// Uploads headers, clears textures.
    virtual void prepare(PassSetup&, RadianceVoxels&) {}
    /// Fills all levels. `emission`: 1 to add what surfaces emit, 0 to leave it out.
    virtual void run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
                     RadianceVoxels& radiance, float emission) = 0;
    /// What was filled stays as it is: a storage may drop what it needs for filling.
    virtual void close(CommandStream&, RadianceVoxels&) {}
};

/// Parameters of the layout svo_bricks; a pass adds schema() to its own with std::tuple_cat.
struct BrickParams {
    bool brickNeighbors = true;
    static constexpr auto schema() {
        return std::tuple{field("brick_neighbors", &BrickParams::brickNeighbors,
                                "Whether the 26 neighbours of each node that surfaces pass through are made "
                                "to exist. Off, values that bricks share differ where one is missing, as in "
                                "Arnebäck 2017, figure 28.")};
    }
};

/// The storage of a layout.
std::unique_ptr<RadianceStorage> makeRadianceStorage(ProgramOwner& owner, RadianceLayout layout,
                                                     const ClipmapParams& clipmap, const BrickParams& bricks);

}  // namespace voxray
