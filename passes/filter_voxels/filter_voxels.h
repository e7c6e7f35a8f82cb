#pragma once

#include "passes/common/clipmap/radiance_clipmap.h"
#include "passes/common/radiance/cone_bounces.h"
#include "passes/common/radiance/radiance_voxels.h"
#include "passes/common/voxels/voxels.h"
#include "passes/filter_voxels/radiance_storage.h"

namespace voxray {

/// Turns lit surface voxels into radiance and opacity at all scales, for cone tracing.
class FilterVoxels final : public Pass {
 public:
    static constexpr const char* kName = "filter_voxels";
    static constexpr const char* kHelp =
        "Prefilters the light that leaves surface voxels: radiance and opacity, the part of a beam that "
        "surfaces hide, at all scales, for gather_cones. "
        "Biased by: voxel size; what shares a larger voxel and faces the same way is averaged; in a clipmap "
        "distance from the camera. Bounces by cones are for dense and svo; over a clipmap's windows "
        "light_clipmap has its own. "
        "Source: Crassin et al. 2011, section 4 (anisotropic voxels); Arnebäck 2017, section 3.1.4.";
    struct Params : ClipmapParams, ClipmapLevelParams, BrickParams, ConeBounceParams {
        RadianceLayout layout = RadianceLayout::Dense;
        bool emission = false;
        static constexpr auto ofClipmaps() {
            return oneOf(&Params::layout, {RadianceLayout::Clipmap, RadianceLayout::ClipmapTextures});
        }
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{field("layout", &Params::layout, kRadianceLayoutHelp),
                           field("emission", &Params::emission,
                                 "Whether what surfaces emit is in. Off, cones bring indirect light alone: a "
                                 "direct_* pass adds the rest.")},
                std::tuple{std::get<0>(ClipmapParams::schema()).onlyWith(ofClipmaps()),
                           std::get<1>(ClipmapParams::schema()).onlyWith(ofClipmaps()),
                           std::get<0>(ClipmapLevelParams::schema()).onlyWith(ofClipmaps()),
                           std::get<0>(BrickParams::schema())
                               .onlyWith(oneOf(&Params::layout, {RadianceLayout::SvoBricks}))},
                ConeBounceParams::schema());
        }
    };

    explicit FilterVoxels(const Params& params);
    Phase phase() const override { return storage_->followsCamera() ? Phase::Frame : Phase::Build; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelIrradiance> irradiance_;
    Port<RadianceVoxels> radiance_;
    std::unique_ptr<RadianceStorage> storage_;
    ConeBounces bounces_;
    bool eachFrame_ = false;  ///< Whether it runs in each frame: storage keeps what it needs for that.
};

}  // namespace voxray
