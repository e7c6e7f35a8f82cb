#pragma once

#include <array>
#include <utility>

#include "passes/common/packed_voxels/packed_voxels.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

enum class PackedLookup { Single, SevenTap };
template <>
struct EnumNames<PackedLookup> {
    static constexpr std::array names{std::pair{PackedLookup::Single, "single"},
                                      std::pair{PackedLookup::SevenTap, "seven_tap"}};
};

/// The final pass as published in Magalhães 2020, sections 3.4.1 and 4.4: the light at a pixel's surface, its
/// normal aside, times the albedo. composite.ambient adds the thesis's ambient light.
class DirectPackedVoxels final : public Pass {
 public:
    static constexpr const char* kName = "direct_packed_voxels";
    static constexpr const char* kHelp =
        "Light from packed voxels: what one word a voxel holds, filtered between voxels. Of light that "
        "secondary rays left there it shows that, too. As published in Magalhães 2020 (section 4.4), for "
        "comparison: direct_voxels is the method to use. Biased by: voxel size; empty voxels, which are "
        "filtered in as black; light from all sides of a surface in one. No noise of its own. Source: "
        "Magalhães 2020, sections 3.4.1 and 4.4.";
    struct Params {
        PackedLookup lookup = PackedLookup::SevenTap;
        static constexpr auto schema() {
            return std::tuple{
                field("lookup", &Params::lookup,
                      "As published in Magalhães 2020. single: trilinear, at the surface. "
                      "seven_tap: the mean of that and of lookups at one voxel's distance along "
                      "each axis (listing 4.8).")};
        }
    };

    explicit DirectPackedVoxels(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const PackedVoxels> voxels_;
    Port<const PackedLight> light_;
    Port<FrameImage> direct_;
    Program program_;
    Sampler sampler_;
};

}  // namespace voxray
