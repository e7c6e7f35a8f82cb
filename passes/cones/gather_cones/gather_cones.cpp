#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/cones/gather_cones/cone_rays.h"
#include "passes/cones/gather_cones/specular_cones.h"
#include "passes/cones/radiance/cone_sets.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {
namespace {

/// Image of the traced texels of the g-buffer, row by row.
ImageDesc tracedImage(const Frame& frame, uint32_t samples, uint32_t stride) {
    ImageDesc desc = frameImageDesc(frame);
    const glm::uvec2 extent = gbufferExtent(frame, samples);
    desc.extent = {(extent.x + stride - 1) / stride, extent.y, 1};
    return desc;
}

constexpr uint32_t kTile = 16;  // TILE of shaders/filter/tiles.glsl.

glm::uvec2 tilesOf(glm::uvec2 pixels) {
    return (pixels + kTile - 1u) / kTile;
}

}  // namespace

/// Indirect light by cone tracing. Source: Crassin et al. 2011; Arnebäck 2017, sections 3.1.5 and 3.2.5.
class GatherCones final : public Pass {
 public:
    static constexpr const char* kName = "gather_cones";
    static constexpr const char* kHelp =
        "Gathers indirect light by a few cones per texel from prefiltered voxels (filter_voxels). "
        "Biased by: voxel size; the number of cones; a mean over some 25 pixels of the same surface, "
        "which evens out the pattern of directions; the shape of specular lobes; with 'visibility: voxels' opacity. "
        "Noisy by: what rays find, near_field_voxels, residual. "
        "Time grows with the cones of each texel, so on a CPU begin with `stride: 4`, a quarter of them, and "
        "`specular: 0` where nothing is glossy. Source: Crassin et al. 2011; Arnebäck 2017, section 3.1.5.";
    struct Params {
        uint32_t cones = 16;
        uint32_t stride = 1;
        uint32_t specular = 7;
        ConeVisibility visibility = ConeVisibility::Rays;
        float nearFieldVoxels = 0;
        float residual = 0;
        uint32_t residualBounces = 8;
        ResidualFilter residualFilter = ResidualFilter::Mean;
        static constexpr auto withResidual() { return noneOf(&Params::residual, {0.0f}); }
        static constexpr auto schema() {
            return std::tuple{
                field("cones", &Params::cones,
                      "Cones that partition the hemisphere; the set of 6 is that of Arnebäck 2017.", coneSetSizes()),
                field("stride", &Params::stride,
                      "Traces every n-th texel of the G-buffer; "
                      "the others have the mean of the traced texels around them on the same surface.",
                      1u, 64u),
                field("specular", &Params::specular,
                      "Cones that partition the specular lobe of each texel of the G-buffer; a mirror has one. "
                      "0: surfaces reflect by their diffuse albedo only.",
                      {0, 1, 7, 19}),
                field("visibility", &Params::visibility,
                      "What a diffuse cone sees. rays: what a ray along its axis hits, with the radiance of the finest "
                      "voxel there. voxels: what their opacities leave visible along it, without rays, as published: "
                      "3 to 8 times slower on a CPU, and up to a third too bright in rooms lit through windows."),
                field("near_field_voxels", &Params::nearFieldVoxels,
                      "Length of the near field, in voxels of the finest level, where rays begin diffuse cones. "
                      "At a hit direct light is sampled by shadow rays and the path continues, up to twice; "
                      "without a hit the cone goes on at the near field's end. 0: no near field.",
                      0.0f, 64.0f),
                field("residual", &Params::residual,
                      "Part of the diffuse cones whose rays go on as paths, and bring (path - cone) / residual beside "
                      "the cone's light: the mean is that of path tracing, whatever the voxels hold. 0: none.",
                      0.0f, 1.0f),
                field("residual_bounces", &Params::residualBounces,
                      "Scattering events of these paths after direct light at what the camera sees, as path_trace "
                      "counts them.",
                      1u, 1024u)
                    .onlyWith(withResidual()),
                field("residual_filter", &Params::residualFilter,
                      "mean: the residual is averaged with the cones' light. apart: it is written to 'noisy_residual', "
                      "for filter_irradiance with 'light: residual', and 'indirect' is without it.")
                    .onlyWith(withResidual())};
        }
    };
    explicit GatherCones(const Params& params) : params_(params) {
        if (params_.specular > 0) specular_.emplace(*this);
        if (hasRays()) rays_.emplace(*this, params_.residual > 0);
    }

    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    void planKeptLight(PassPlan& plan);
    /// Gives back what the mean over texels lost, and adds the lobes, if any.
    void keepLight(PassContext& context, const std::vector<Binding>& reflected);
    void planRays(PassPlan& plan, const RadianceVoxels& radiance, glm::uvec2 tracedExtent);
    bool isResidualApart() const { return params_.residual > 0 && params_.residualFilter == ResidualFilter::Apart; }
    /// The residual where it is apart, else null.
    NoisyIrradiance* residualApart(const PortAccess& access) const {
        return isResidualApart() ? &access[noisy_] : nullptr;
    }
    /// Whether what the mean over texels loses is given back: not to marched cones, which stay as published.
    bool keepsLight() const { return params_.visibility == ConeVisibility::Rays || params_.residual > 0; }
    bool hasRays() const {
        return params_.visibility == ConeVisibility::Rays || params_.nearFieldVoxels > 0 || params_.residual > 0;
    }

    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light"};
    Out<SpecularLobes> lobes_{*this, "lobes",
                              "what specular lobes reflect; a pass that reads it joins it with 'indirect'",
                              params_.specular > 0};
    Out<NoisyIrradiance> noisy_{*this, "noisy_residual", "irradiance that the cones lack", isResidualApart()};
    Kernel trace_{*this, "trace_cones.comp"};
    Kernel resolve_{*this, "resolve.comp"};
    Kernel resolveLobes_{*this, "resolve.comp", {{"SPECULAR", "1"}}};
    // Where rays see
    Kernel findFactors_{*this, "kept_light.comp"};
    Kernel keepLight_{*this, "keep_light.comp"};
    Kernel keepLightWithLobes_{*this, "keep_light.comp", {{"SPECULAR", "1"}}};
    Buffer tiles_, raised_;  ///< TileLight of each tile (tiles.glsl), and the factor of its light.
    Buffer cones_;
    Image irradiance_;
    std::optional<SpecularCones> specular_;
    std::optional<ConeRays> rays_;
};

void GatherCones::plan(PassPlan& plan) {
    const RadianceVoxels& radiance = plan[radiance_];
    plan.buffer(cones_, "cones", coneSet(params_.cones).size() * sizeof(gpu::Cone));
    const bool hasResidual = params_.residual > 0 && !isResidualApart();
    plan[indirect_].lightBounces = hasResidual ? std::optional(params_.residualBounces) : radiance.lightBounces;
    plan[indirect_].hasSpecularLobes = params_.specular > 0;
    plan.frameImage(indirect_);
    const ImageDesc traced = tracedImage(plan.frame, plan[gbuffer_].samples, params_.stride);
    plan.image(irradiance_, "gathered irradiance", traced);
    if (rays_) planRays(plan, radiance, traced.extent);
    trace_.define(radiance.defines());
    trace_.compileIf(!rays_);
    resolveLobes_.compileIf(params_.specular > 0);
    if (keepsLight()) planKeptLight(plan);
    findFactors_.compileIf(keepsLight());
    keepLight_.compileIf(keepsLight());
    keepLightWithLobes_.compileIf(keepsLight() && params_.specular > 0);
    if (params_.specular == 0) return;
    SpecularLobes& lobes = plan[lobes_];
    lobes.isJoined = false;
    lobes.emission = radiance.emission;
    specular_->plan(plan, plan[gbuffer_], radiance, params_.specular, lobes.reflected);
}

void GatherCones::planKeptLight(PassPlan& plan) {
    const glm::uvec2 tiles = tilesOf(plan.frame.pixels());
    const uint64_t count = uint64_t(tiles.x) * tiles.y;
    plan.buffer(tiles_, "light of tiles", count * 2 * sizeof(glm::vec3));
    plan.buffer(raised_, "factors of tiles", count * sizeof(glm::vec3));
    for (Kernel* kernel : {&resolve_, &resolveLobes_}) kernel->define({{"KEEPS_LIGHT", "1"}});
}

void GatherCones::planRays(PassPlan& plan, const RadianceVoxels& radiance, glm::uvec2 tracedExtent) {
    if (radiance.emission && params_.residual > 0)
        throw Error(
            "gather_cones: 'residual' measures light at hits without what they emit, which the radiance voxels hold; "
            "set it to 0, or 'emission' of filter_voxels to false");
    if (isResidualApart() && params_.specular > 0)
        throw Error(
            "gather_cones: a filter of the residual takes all surfaces for diffuse; set 'specular' to 0, or "
            "'residual_filter' to mean");
    if (isResidualApart() && !plan[noisy_].isRead)
        throw Error(
            "gather_cones: with 'residual_filter: apart' a filter_irradiance with 'light: residual' must follow, or the "
            "residual is lost");
    rays_->plan(plan, radiance,
                {.visibility = params_.visibility,
                 .nearVoxels = params_.nearFieldVoxels,
                 .residual = params_.residual,
                 .bounces = params_.residualBounces,
                 .cones = params_.cones,
                 .stride = params_.stride,
                 .samples = plan[gbuffer_].samples,
                 .tracedExtent = tracedExtent,
                 .width = coneSet(params_.cones).back().width},
                residualApart(plan));
}

void GatherCones::prepare(PassSetup& setup) {
    if (specular_) specular_->prepare(setup);
    setup.stream.upload(cones_, coneSet(params_.cones));
}

void GatherCones::record(PassContext& context) {
    const GBuffer& gbuffer = context[gbuffer_];
    const RadianceVoxels& radiance = context[radiance_];
    if (rays_)
        rays_->record(context, gbuffer, radiance, cones_, irradiance_, residualApart(context));
    else
        context.dispatch(trace_, irradiance_.desc().extent,
                         {gbuffer,
                          radiance,
                          {"cones", cones_},
                          {"irradiance", irradiance_},
                          {"coneCount", params_.cones},
                          {"stride", params_.stride}});

    // Unless a later pass adds the lobes; isJoined is final after all plans.
    std::vector<Binding> reflected;
    if (specular_) {
        const SpecularLobes& lobes = context[lobes_];
        specular_->record(context, gbuffer, radiance, lobes.reflected);
        if (!lobes.isJoined) reflected.emplace_back("reflected", lobes.reflected);
    }
    context.dispatch(reflected.empty() ? resolve_ : resolveLobes_, context.frame.pixels(),
                     {gbuffer,
                      reflected,
                      {"irradiance", irradiance_},
                      {"result", context[indirect_].image},
                      ifUsed({"tiles", tiles_}),
                      {"stride", params_.stride},
                      {"voxelSize", radiance.grid.voxelSize}});
    if (keepsLight()) keepLight(context, reflected);
}

void GatherCones::keepLight(PassContext& context, const std::vector<Binding>& reflected) {
    const glm::uvec2 tiles = tilesOf(context.frame.pixels());
    context.dispatch(findFactors_, tiles, {{"tiles", tiles_}, {"raised", raised_}, {"tileCount", tiles}});
    context.dispatch(reflected.empty() ? keepLight_ : keepLightWithLobes_, context.frame.pixels(),
                     {reflected,
                      {"raised", raised_},
                      {"result", context[indirect_].image},
                      ifUsed({"samples", context[gbuffer_].samples})});
}

VOXRAY_REGISTER_PASS(GatherCones);

}  // namespace voxray
