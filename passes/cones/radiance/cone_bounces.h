#pragma once

#include <tuple>
#include <utility>
#include <vector>

#include "passes/common/voxels/voxels.h"
#include "passes/cones/radiance/cone_sets.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Parameters of a pass with bounces by cones; it adds schema() to its own with std::tuple_cat.
struct ConeBounceParams {
    uint32_t bounces = 0;
    uint32_t bounceCones = 6;
    static constexpr auto schema() {
        return std::tuple{
            field("bounces", &ConeBounceParams::bounces,
                  "Bounces of light from voxel to voxel by cones, in addition to those of the injection.", 0u, 32u),
            field("bounce_cones", &ConeBounceParams::bounceCones, "Cones from each face of a voxel in a bounce.",
                  coneSetSizes())
                .onlyWith(noneOf(&ConeBounceParams::bounces, {0u}))};
    }
};

/// Diffuse interreflection between surface voxels: irradiance of each voxel's faces by a set of cones through
/// radiance voxels. Docs: docs/cone-tracing.md.
class ConeBounces {
 public:
    /// @param cones in the set, see coneSet().
    ConeBounces(ProgramOwner& owner, uint32_t cones);

    /// Only where there are bounces: without this call nothing is compiled. @param radiance with its layout.
    void plan(PassPlan& plan, const RadianceVoxels& radiance);
    /// Only where there are bounces.
    void prepare(PassSetup& setup);
    /// Gathers flux at the voxels' faces from the current contents of `radiance`, into `flux()`.
    /// @param injected light, by which the insides of solids are recognized.
    void gather(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& injected,
                const RadianceVoxels& radiance);
    /// Laid out as VoxelIrradiance::indirect.
    const LargeBuffer& flux() const { return flux_; }
    /// The same, handed over: the next gather() allocates anew.
    LargeBuffer takeFlux() { return std::move(flux_); }
    /// Frees the buffers of gather(). Waits for the device.
    void release(CommandStream& stream);

 private:
    void listVoxels(PassContext& context, const SurfaceVoxels& voxels);

    uint32_t cones_;
    Kernel listVoxels_, gather_;
    Buffer coneSet_, voxelCoordinates_;
    LargeBuffer flux_;
};

}  // namespace voxray
