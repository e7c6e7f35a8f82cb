#pragma once

#include <array>
#include <string>

#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

enum class VoxelLookup { Trilinear, SevenTap, BilinearFace };

template <>
struct EnumNames<VoxelLookup> {
    static constexpr std::array names{std::pair{VoxelLookup::Trilinear, "trilinear"},
                                      std::pair{VoxelLookup::SevenTap, "seven_tap"},
                                      std::pair{VoxelLookup::BilinearFace, "bilinear_face"}};
};

/// Light reflected at every pixel's surface, albedo / pi times the irradiance that voxels hold there: all of
/// gather_irradiance (indirect flux) and of direct_voxels (direct flux) but their names.
class VoxelLookupPass : public Pass {
 public:
    struct Params {
        float radius = 1.0f;
        VoxelLookup lookup = VoxelLookup::Trilinear;
        static constexpr auto schema() {
            return std::tuple{
                field("radius", &Params::radius,
                      "Reach of the interpolation in voxels; 1 is trilinear, more is smoother and blurs.",
                      0.5f, 8.0f)
                    .onlyWith(noneOf(&Params::lookup, {VoxelLookup::BilinearFace})),
                field("lookup", &Params::lookup,
                      "trilinear: at the surface. seven_tap: there and at one voxel's distance along each "
                      "axis, which hides holes in the voxels and blurs (Magalhães 2020, listing 4.8; there "
                      "empty voxels count as black, here they are left out). bilinear_face: the face most "
                      "like the normal alone, between four voxels of one layer (Cosin and Patow 2022).")};
        }
    };

    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 protected:
    /// @param port what the pass writes, and its help. @param flux VoxelIrradiance::direct or ::indirect.
    VoxelLookupPass(const Params& params, std::string port, std::string help,
                    LargeBuffer VoxelIrradiance::*flux);

 private:
    /// Voxels along each axis round that of a point that are read for it, at most.
    uint32_t reach() const;

    const Params params_;
    const std::string portName_;
    LargeBuffer VoxelIrradiance::*const flux_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    Out<FrameImage> reflected_;
    Kernel program_{*this, "voxel_lookup.comp"};
};

}  // namespace voxray
