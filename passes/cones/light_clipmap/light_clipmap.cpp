#include <algorithm>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/lights/shadow_map.h"
#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxels/flux_accumulator.h"
#include "passes/cones/clipmap/clipmap_voxels.h"
#include "passes/cones/clipmap/radiance_clipmap.h"
#include "passes/cones/radiance/cone_bounces.h"

namespace voxray {

/// The layouts of radiance voxels that the pass can fill.
enum class ClipmapLayout {
    Clipmap = int(RadianceLayout::Clipmap),
    ClipmapTextures = int(RadianceLayout::ClipmapTextures)
};
template <>
struct EnumNames<ClipmapLayout> {
    static constexpr std::array names{std::pair{ClipmapLayout::Clipmap, "clipmap"},
                                      std::pair{ClipmapLayout::ClipmapTextures, "clipmap_textures"}};
};

/// Lights the surface voxels of a clipmap by shadow maps, per clipped triangle, and fills radiance voxels
/// with what they reflect. Docs: docs/clipmap.md.
class LightClipmap final : public Pass {
 public:
    static constexpr const char* kName = "light_clipmap";
    static constexpr const char* kHelp =
        "Lights the voxels of voxelize_clipmap by shadow maps and prefilters them for gather_cones. "
        "Each triangle clipped to a voxel is tested against the map of each light. "
        "The cones gather one bounce more than 'bounces'. Each frame updates voxels that scrolled in; "
        "all if a light or a surface has moved, and with bounces if any scrolled in. Only for punctual lights: "
        "emissive surfaces and the environment have no single viewpoint. Biased by: voxel size, "
        "so distance from the camera; shadow_resolution. Source: Arnebäck 2017, section 4.1.2, after Panteleev 2014.";
    struct Params : ClipmapLevelParams, ConeBounceParams {
        uint32_t shadowResolution = 512;
        ClipmapLayout layout = ClipmapLayout::Clipmap;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{field("shadow_resolution", &Params::shadowResolution,
                                 "Texels along an edge of each shadow map; a point light has six.", 2u, 4096u),
                           field("layout", &Params::layout,
                                 "How voxels are stored: clipmap, in a buffer; clipmap_textures, "
                                 "as published in Arnebäck 2017: in a 3D texture that the device's sampler filters.")},
                ClipmapLevelParams::schema(), ConeBounceParams::schema());
        }
    };
    explicit LightClipmap(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Updates light and all levels where windows or, with `moved`, lights or surfaces have changed.
    void relight(PassContext& context, bool moved);
    /// Direct light of the voxels in boxes of a level. @param voxels include these.
    VoxelIrradiance directLight(PassContext& context, const SurfaceVoxels& voxels, const std::vector<VoxelBox>& boxes);
    /// Fills boxes of a level with the radiance that surface voxels reflect.
    void fillWindow(PassContext& context, uint32_t level, const SurfaceVoxels& voxels,
                    const std::vector<VoxelBox>& boxes, const VoxelIrradiance& light, const LargeBuffer& indirect);
    /// Filters the levels above the first whole one, each from the next finer level.
    void fillCoarseLevels(PassContext& context);

    const Params params_;
    In<ClipmapVoxels> clipmap_{*this, "clipmap", "surface voxels to light"};
    Out<RadianceVoxels> radiance_{*this, "radiance", "light that leaves them, at all scales"};
    std::vector<LightSource> sources_;
    RadianceClipmap storage_;
    ShadowMaps shadowMaps_{*this};
    std::unique_ptr<TriangleVoxelizer> voxelizer_ = makeExactVoxelizer();
    std::unique_ptr<PassProgram> lightVoxels_ =
        voxelizer_->makeProgram(*this, "passes/cones/light_clipmap/light_voxels");
    Kernel litArea_{*this, "lit_area.comp"};
    Kernel fillWindow_{*this, "fill_window.comp"};
    Kernel filterLevel_{*this, "passes/cones/radiance/filter_level.comp"};
    FluxAccumulator flux_{*this};
    ConeBounces bounces_{*this, params_.bounceCones};
    std::optional<uint64_t> sceneVersion_;  ///< Of the last frame.
    uint64_t updatedVoxels_ = 0;            ///< In this frame.
};

void LightClipmap::plan(PassPlan& plan) {
    requireClearPanes(*plan.frame.scene, kName);
    if (!plan.device.shaderInt64Atomics)
        throw Error("{}: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics)", kName,
                    plan.device.name);
    sources_ = requirePunctualLights(*plan.frame.scene, kName);
    const ClipmapVoxels& clipmap = plan[clipmap_];
    RadianceVoxels& radiance = plan[radiance_];
    radiance.lightBounces = params_.bounces + 1;
    radiance.layout = RadianceLayout(params_.layout);
    radiance.euclidean = params_.levelDistance == LevelDistance::Euclidean;
    radiance.grid = clipmap.grid;
    radiance.grid.unit = radianceUnit(*plan.frame.scene);
    storage_ = RadianceClipmap(clipmap.grid, clipmap.windows.windowSize());
    storage_.plan(plan, kName, radiance);
    shadowMaps_.plan(plan, sources_, params_.shadowResolution);

    if (params_.bounces > 0) bounces_.plan(plan, radiance);
    for (Kernel* kernel : {&fillWindow_, &filterLevel_}) kernel->define(radiance.defines());
}

void LightClipmap::prepare(PassSetup& setup) {
    storage_.prepare(setup, setup[radiance_]);
    if (params_.bounces > 0) bounces_.prepare(setup);
}

void LightClipmap::record(PassContext& context) {
    const ClipmapVoxels& clipmap = context[clipmap_];
    RadianceVoxels& radiance = context[radiance_];
    storage_.moveWindows(context, radiance);

    // A light or a surface that moved may change shadows anywhere
    const bool moved = sceneVersion_ != context.frame.sceneVersion;
    if (moved) shadowMaps_.draw(context, sources_);
    sceneVersion_ = context.frame.sceneVersion;
    const bool updated =
        std::ranges::any_of(clipmap.levels, [](const ClipmapVoxels::Level& level) { return !level.boxes.empty(); });
    updatedVoxels_ = 0;
    if (moved || updated) relight(context, moved);
    context.report(kUpdatedVoxels, double(updatedVoxels_));
}

void LightClipmap::relight(PassContext& context, bool moved) {
    const ClipmapVoxels& clipmap = context[clipmap_];
    const RadianceVoxels& radiance = context[radiance_];
    // Bounced light may change anywhere
    const bool everywhere = moved || params_.bounces > 0;

    // Direct light
    std::vector<VoxelIrradiance> lights(clipmap.levels.size());
    for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
        const ClipmapVoxels::Level& level = clipmap.levels[l];
        const SurfaceVoxels& voxels = everywhere || !level.updated.materials ? level.voxels : level.updated;
        const std::vector<VoxelBox> boxes = everywhere ? std::vector{windowVoxels(voxels.grid)} : level.boxes;
        if (boxes.empty()) continue;
        VoxelIrradiance direct = directLight(context, voxels, boxes);
        fillWindow(context, l, voxels, boxes, direct, direct.indirect);
        if (params_.bounces > 0) lights[l] = std::move(direct);
    }
    if (everywhere || !clipmap.levels.back().boxes.empty()) fillCoarseLevels(context);

    // Each iteration adds one bounce. All levels are gathered before any is filled.
    for (uint32_t bounce = 1; bounce <= params_.bounces; ++bounce) {
        std::vector<LargeBuffer> flux(clipmap.levels.size());
        for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
            const SurfaceVoxels& voxels = clipmap.levels[l].voxels;
            if (voxels.voxelCount == 0) continue;
            bounces_.gather(context, voxels, lights[l], radiance);
            flux[l] = bounces_.takeFlux();
        }
        for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
            const SurfaceVoxels& voxels = clipmap.levels[l].voxels;
            if (voxels.voxelCount == 0) continue;
            fillWindow(context, l, voxels, {windowVoxels(voxels.grid)}, lights[l], flux[l]);
        }
        fillCoarseLevels(context);
    }
    if (params_.bounces > 0) bounces_.release(context.stream);
}

VoxelIrradiance LightClipmap::directLight(PassContext& context, const SurfaceVoxels& voxels,
                                          const std::vector<VoxelBox>& boxes) {
    CommandStream& stream = context.stream;
    const Geometry& geometry = context.frame.scene->geometry;
    const uint64_t count = std::max(voxels.voxelCount, 1u);

    // Light on the clipped fragments in the boxes
    const VoxelRegion region(voxels.grid, boxes);
    voxelizer_->select(context, voxels.grid, region, region.triangles(geometry));
    const Buffer litArea(context.device, "lit area", count * kFaces * sizeof(uint32_t));
    stream.fill(litArea, 0);
    flux_.begin(context.device, stream, voxels, totalPower(sources_));
    const Bindings bindings{voxels, flux_.bindings(), shadowMaps_.bindings(), {"litArea", litArea}};
    voxelizer_->run(context, *lightVoxels_, voxels.grid, bindings.all(), flux_.unitsPerWatt());
    VoxelIrradiance irradiance;
    irradiance.allocate(context.device, uint32_t(count));
    stream.fill(irradiance.indirect, 0);
    flux_.resolve(stream, voxels, irradiance.direct);
    context.dispatch(litArea_, voxels.voxelCount,
                     {voxels, {"litArea", litArea}, {"area", irradiance.area}, {"voxelCount", voxels.voxelCount}});

    stream.finish();
    voxelizer_->release();
    flux_.end();
    return irradiance;
}

void LightClipmap::fillWindow(PassContext& context, uint32_t level, const SurfaceVoxels& voxels,
                              const std::vector<VoxelBox>& boxes, const VoxelIrradiance& light,
                              const LargeBuffer& indirect) {
    for (const VoxelBox& box : boxes) {
        context.dispatch(fillWindow_, box.count(),
                         {voxels,
                          context[radiance_].fillBindings(),
                          {"DirectFluxRef", light.direct.ref()},
                          {"IndirectFluxRef", indirect.ref()},
                          {"voxelArea", light.area},
                          {"boxFirst", box.first},
                          {"boxSize", box.size},
                          {"level", level}});
        updatedVoxels_ += box.count();
    }
    context.stream.finish();
}

void LightClipmap::fillCoarseLevels(PassContext& context) {
    const RadianceVoxels& radiance = context[radiance_];
    for (uint32_t l = storage_.windows().firstWhole() + 1; l < radiance.grid.levels; ++l) {
        const uint64_t voxels = levelVoxels(radiance.grid.resolution, l);
        context.dispatch(filterLevel_, voxels, {radiance.fillBindings(), {"level", l}});
        updatedVoxels_ += voxels;
    }
}

VOXRAY_REGISTER_PASS(LightClipmap);

}  // namespace voxray
