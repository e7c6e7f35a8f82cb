#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

enum class GatheredLight { Indirect, Direct };
template <>
struct EnumNames<GatheredLight> {
    static constexpr std::array names{std::pair{GatheredLight::Indirect, "indirect"},
                                      std::pair{GatheredLight::Direct, "direct"}};
};

enum class VoxelLookup { Trilinear, SevenTap, BilinearFace, NearestFace };
template <>
struct EnumNames<VoxelLookup> {
    static constexpr std::array names{
        std::pair{VoxelLookup::Trilinear, "trilinear"}, std::pair{VoxelLookup::SevenTap, "seven_tap"},
        std::pair{VoxelLookup::BilinearFace, "bilinear_face"}, std::pair{VoxelLookup::NearestFace, "nearest_face"}};
};

/// Light of each pixel by a lookup in the voxels at its surface: albedo / pi times the irradiance there.
/// Source: Magalhães 2020, section 3.4.
class GatherIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "gather_irradiance";
    static constexpr const char* kHelp =
        "Looks light up in the voxels' irradiance at each pixel. "
        "The irradiance is interpolated at the pixel's surface, for the surface's normal; no ray is traced. "
        "Biased by: voxel size (detail below it is lost, shadows too with `light: direct`; "
        "light leaks around thin edges). Noisy by: the injection's rays. Lambert surfaces only. "
        "Source: Magalhães 2020, section 3.4.";
    struct Params {
        GatheredLight light = GatheredLight::Indirect;
        float radius = 1.0f;
        VoxelLookup lookup = VoxelLookup::Trilinear;
        static constexpr auto schema() {
            return std::tuple{
                field("light", &Params::light,
                      "indirect: light that was reflected at least once. "
                      "direct: light straight from its sources, in place of direct_shadow_rays."),
                field("radius", &Params::radius,
                      "Radius of the interpolation's kernel in voxels; 1 is trilinear, more is smoother.", 0.5f, 8.0f)
                    .onlyWith(oneOf(&Params::lookup, {VoxelLookup::Trilinear, VoxelLookup::SevenTap})),
                field("lookup", &Params::lookup,
                      "trilinear: at the surface. seven_tap: there and at one voxel's distance along each axis, "
                      "which hides holes in the voxels and blurs (Magalhães 2020, listing 4.8, "
                      "but empty voxels are omitted instead of black). bilinear_face: "
                      "only the face closest to the normal, between four voxels of one layer (Cosin and Patow 2022). "
                      "nearest_face: that face of the surface's own voxel, without interpolation (figure 12 there).")};
        }
    };

    explicit GatherIrradiance(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool isDirect() const { return params_.light == GatheredLight::Direct; }
    /// Maximum distance along an axis of voxels that are read for a point from the voxel that contains it.
    uint32_t reach() const;

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<VoxelLevels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    Out<FrameImage> reflected_{*this, enumName(params_.light),
                               "radiance reflected of " + enumName(params_.light) + " light"};
    Kernel lookup_{*this, "gather_irradiance.comp"};
};

uint32_t GatherIrradiance::reach() const {
    const bool usesRadius = params_.lookup == VoxelLookup::Trilinear || params_.lookup == VoxelLookup::SevenTap;
    const float radius = usesRadius ? params_.radius : 1.0f;
    const uint32_t tap = params_.lookup == VoxelLookup::SevenTap ? 1 : 0;
    // voxel_irradiance.glsl reads centers closer than the radius, which it doubles up to twice; the point may
    // be anywhere in its voxel
    return uint32_t(std::ceil(4 * radius + 0.5f)) - 1 + tap;
}

void GatherIrradiance::plan(PassPlan& plan) {
    const std::optional<uint32_t> gathered = plan[irradiance_].reach;
    if (gathered && *gathered < reach())
        throw Error(
            "the lookup reads voxels up to {} from what the camera sees, and light is gathered for those up to {}; "
            "set the 'reach' of gather_clusters to {}",
            reach(), *gathered, reach());
    if (!isDirect()) plan[reflected_].lightBounces = plan[irradiance_].lightBounces;
    plan.frameImage(reflected_);
}

void GatherIrradiance::record(PassContext& context) {
    const VoxelIrradiance& irradiance = context[irradiance_];
    context.dispatch(lookup_, context.frame.pixels(),
                     {context[gbuffer_],
                      context[voxels_],
                      {"VoxelFluxRef", (isDirect() ? irradiance.direct : irradiance.indirect).ref()},
                      {"voxelArea", irradiance.area},
                      {"result", context[reflected_].image},
                      {"radius", params_.radius},
                      {"lookup", params_.lookup}});
}

VOXRAY_REGISTER_PASS(GatherIrradiance);

}  // namespace voxray
