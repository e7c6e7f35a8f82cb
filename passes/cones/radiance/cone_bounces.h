#pragma once

#include <tuple>
#include <utility>
#include <vector>

#include "passes/common/voxels/voxels.h"
#include "passes/cones/radiance/cone_sets.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// The parameters of a pass that lets light bounce by cones; it adds schema() to its own with std::tuple_cat.
struct ConeBounceParams {
    uint32_t bounces = 0;
    uint32_t bounceCones = 6;
    static constexpr auto schema() {
        return std::tuple{
            field("bounces", &ConeBounceParams::bounces,
                  "Bounces of light from voxel to voxel by cones, in addition to those of the injection.", 0u,
                  32u),
            field("bounce_cones", &ConeBounceParams::bounceCones,
                  "Cones from each face of a voxel in a bounce.", coneSetSizes())
                .onlyWith(noneOf(&ConeBounceParams::bounces, {0u}))};
    }
};

/// Light that voxels throw at each other: irradiance of each voxel's faces by a set of cones through radiance
/// voxels. Docs: docs/cone-tracing.md.
class ConeBounces {
 public:
    /// @param cones of the set, see coneSet().
    ConeBounces(ProgramOwner& owner, uint32_t cones);

    /// Where light bounces: without it nothing is compiled. @param radiance with its layout.
    void plan(PassPlan& plan, const RadianceVoxels& radiance);
    /// Likewise.
    void prepare(PassSetup& setup);
    /// Flux that arrives at the voxels' faces from what `radiance` holds now, into `flux()`.
    /// @param injected light, which tells the insides of solids.
    void gather(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& injected,
                const RadianceVoxels& radiance);
    /// As VoxelIrradiance::indirect.
    const LargeBuffer& flux() const { return flux_; }
    /// The same, to keep: the next gather() begins again.
    LargeBuffer takeFlux() { return std::move(flux_); }
    /// Frees what gather() took and would keep for the next one. Waits for the device.
    void release(CommandStream& stream);

 private:
    void list(PassContext& context, const SurfaceVoxels& voxels);

    uint32_t cones_;
    Kernel list_, gather_;
    Buffer coneSet_, voxelCoordinates_;
    LargeBuffer flux_;
};

}  // namespace voxray
