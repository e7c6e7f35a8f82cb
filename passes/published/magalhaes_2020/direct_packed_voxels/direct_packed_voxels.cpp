#include <array>
#include <utility>

#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/published/magalhaes_2020/packed_voxels.h"

namespace voxray {

enum class PackedLookup { Single, SevenTap };
template <>
struct EnumNames<PackedLookup> {
    static constexpr std::array names{std::pair{PackedLookup::Single, "single"},
                                      std::pair{PackedLookup::SevenTap, "seven_tap"}};
};

/// The final pass as published in Magalhães 2020, sections 3.4.1 and 4.4: irradiance at a pixel's surface,
/// whatever its normal, times the albedo. composite.ambient adds the thesis's ambient light.
class DirectPackedVoxels final : public Pass {
 public:
    static constexpr const char* kName = "direct_packed_voxels";
    static constexpr const char* kHelp =
        "Looks light up in packed voxels, filtered between voxels. A voxel's light is in one word, "
        "which includes light of secondary rays. As published in Magalhães 2020 (section 4.4), for comparison: "
        "use gather_irradiance with `light: direct` instead. Biased by: voxel size; "
        "empty voxels, which are interpolated as black; light from both sides of a surface in one value. "
        "No noise of its own. Source: Magalhães 2020, sections 3.4.1 and 4.4.";
    struct Params {
        PackedLookup lookup = PackedLookup::SevenTap;
        static constexpr auto schema() {
            return std::tuple{field("lookup", &Params::lookup,
                                    "As published in Magalhães 2020. single: trilinear, at the surface. "
                                    "seven_tap: the mean of this and "
                                    "of lookups at one voxel's distance along each axis (listing 4.8).")};
        }
    };

    explicit DirectPackedVoxels(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override {
        plan[direct_].lightBounces = plan[light_].lightBounces;
        plan.frameImage(direct_);
        lookUp_.specialize({{"kSevenTap", params_.lookup == PackedLookup::SevenTap}});
    }
    void record(PassContext& context) override {
        const PackedLight& light = context[light_];
        context.dispatch(lookUp_, context.frame.pixels(),
                         {context[gbuffer_],
                          {"IrradianceRef", light.irradiance.ref()},
                          {"result", context[direct_].image},
                          {"grid", context[voxels_].grid},
                          {"white", light.white}});
    }

 private:
    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<PackedVoxels> voxels_{*this, "packed_voxels", "the voxels that hold the light"};
    In<PackedLight> light_{*this, "packed_light", "light that arrives in voxels, one word a voxel"};
    Out<FrameImage> direct_{*this, "direct", "radiance reflected of the light in voxels"};
    Kernel lookUp_{*this, "direct_packed_voxels.comp"};
};
VOXRAY_REGISTER_PASS(DirectPackedVoxels);

}  // namespace voxray
