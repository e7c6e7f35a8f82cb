#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/voxels/voxels.h"
#include "passes/cones/clipmap/radiance_clipmap.h"
#include "passes/cones/filter_voxels/radiance_storage.h"
#include "passes/cones/radiance/cone_bounces.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Prefilters lit surface voxels into radiance and opacity at all scales, for cone tracing. Sources: Crassin
/// et al. 2011, section 4; Arnebäck 2017, section 3.1.4.
class FilterVoxels final : public Pass {
 public:
    static constexpr const char* kName = "filter_voxels";
    static constexpr const char* kHelp =
        "Prefilters surface voxels into radiance and opacity at all scales, for gather_cones. "
        "Opacity is the fraction of a beam that surfaces occlude. Biased by: voxel size; "
        "surfaces in a larger voxel that face the same way are averaged; in a clipmap distance from the camera. "
        "Bounces by cones work with the layouts dense and svo; for clipmaps light_clipmap has them. "
        "Source: Crassin et al. 2011, section 4 (anisotropic voxels); Arnebäck 2017, section 3.1.4.";
    struct Params : ClipmapParams, ClipmapLevelParams, BrickParams, ConeBounceParams {
        RadianceLayout layout = RadianceLayout::Dense;
        bool emission = false;
        static constexpr auto ifClipmap() {
            return oneOf(&Params::layout, {RadianceLayout::Clipmap, RadianceLayout::ClipmapTextures});
        }
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{field("layout", &Params::layout, kRadianceLayoutHelp),
                           field("emission", &Params::emission,
                                 "Whether radiance includes what surfaces emit. "
                                 "Off, cones gather indirect light only: a direct_* pass adds the rest.")},
                std::tuple{
                    std::get<0>(ClipmapParams::schema()).onlyWith(ifClipmap()),
                    std::get<1>(ClipmapParams::schema()).onlyWith(ifClipmap()),
                    std::get<0>(ClipmapLevelParams::schema()).onlyWith(ifClipmap()),
                    std::get<0>(BrickParams::schema()).onlyWith(oneOf(&Params::layout, {RadianceLayout::SvoBricks}))},
                ConeBounceParams::schema());
        }
    };
    explicit FilterVoxels(const Params& params) : params_(params) {}

    Phase phase() const override { return storage_->followsCamera() ? Phase::Frame : Phase::Build; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    Out<RadianceVoxels> radiance_{*this, "radiance", "light that leaves them, at all scales"};
    std::unique_ptr<RadianceStorage> storage_ = makeRadianceStorage(*this, params_.layout, params_, params_);
    ConeBounces bounces_{*this, params_.bounceCones};
    bool eachFrame_ = false;  ///< Runs in each frame: the storage is not finalized.
};

void FilterVoxels::plan(PassPlan& plan) {
    eachFrame_ = plan.phase == Phase::Frame;
    const gpu::VoxelGrid& grid = plan[voxels_].grid;
    if (params_.bounces > 0 && storage_->followsCamera())
        throw Error(
            "filter_voxels: 'bounces' needs all voxels, of which this layout holds those near the camera; "
            "set 'layout' to dense or svo, or the injection's own 'bounces', "
            "or take voxelize_clipmap and light_clipmap");
    RadianceVoxels& radiance = plan[radiance_];
    if (const auto injected = plan[irradiance_].lightBounces) radiance.lightBounces = *injected + params_.bounces + 1;
    radiance.layout = params_.layout;
    radiance.emission = params_.emission;
    radiance.euclidean = params_.levelDistance == LevelDistance::Euclidean;
    radiance.grid = {grid.origin,     grid.voxelSize,
                     grid.resolution, gridLevels(grid.resolution),
                     grid.directions, radianceUnit(*plan.frame.scene)};
    storage_->plan(plan, plan[voxels_], radiance);
    if (params_.bounces > 0) bounces_.plan(plan, radiance);
}

void FilterVoxels::prepare(PassSetup& setup) {
    storage_->prepare(setup, setup[radiance_]);
    if (params_.bounces > 0) bounces_.prepare(setup);
}

void FilterVoxels::record(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    const VoxelIrradiance& irradiance = context[irradiance_];
    RadianceVoxels& radiance = context[radiance_];
    const auto fill = [&](const LargeBuffer& indirect, bool last) {
        storage_->run(context, voxels, {irradiance.direct, indirect, irradiance.area, context.changed(irradiance_)},
                      radiance, last && params_.emission ? 1.0f : 0.0f);
    };

    // Each iteration adds one bounce to the light of the last one. Emission is added in the last: the light
    // that it sheds on other surfaces is direct light.
    fill(irradiance.indirect, params_.bounces == 0);
    for (uint32_t bounce = 1; bounce <= params_.bounces; ++bounce) {
        bounces_.gather(context, voxels, irradiance, radiance);
        fill(bounces_.flux(), bounce == params_.bounces);
    }
    if (eachFrame_) return;
    if (params_.bounces > 0) bounces_.release(context.stream);
    storage_->finalize(context.stream, radiance);
}

VOXRAY_REGISTER_PASS(FilterVoxels);

}  // namespace voxray
