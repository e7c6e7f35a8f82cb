#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <optional>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/lights/shadow_map.h"
#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"
#include "passes/common/voxel_builder/changed_voxels.h"
#include "passes/common/voxels/voxels.h"
#include "passes/cones/clipmap/radiance_clipmap.h"

namespace voxray {
namespace {

/// Boxes one voxel larger on each side: a fragment's voxel is up to one voxel outside of its triangle's bounds,
/// where the line through the pixel's center meets the plane outside of the triangle.
std::vector<VoxelBox> enlarged(std::vector<VoxelBox> boxes) {
    for (VoxelBox& box : boxes) box = {box.first - 1, box.size + 2u};
    return boxes;
}

/// The voxels within the bounds of boxes that are in the grid.
gpu::VoxelGrid gridOfBoxes(gpu::VoxelGrid grid, const std::vector<VoxelBox>& boxes) {
    const VoxelRegion region(grid, boxes);
    grid.first = glm::max(glm::ivec3(region.low()), 0);
    grid.resolution = glm::min(grid.resolution, glm::uvec3(glm::max(region.high(), 0.0f)));
    return grid;
}

bool isSameLight(const Light& a, const Light& b) {
    return a.position == b.position && a.direction == b.direction && a.intensity == b.intensity;
}

}  // namespace

/// Voxelization and light injection of a clipmap as published in Arnebäck 2017, sections 4.1.1, 4.1.2 (the
/// fourth way) and 4.2: the triangles are rasterized into each level as voxelize_octree does, each fragment is
/// lit by shadow maps, and its voxel keeps a moving average.
class RasterizeClipmap final : public Pass {
 public:
    static constexpr const char* kName = "rasterize_clipmap";
    static constexpr const char* kHelp =
        "Rasterizes triangles into a clipmap around the camera and lights their fragments. "
        "Each level is rasterized by itself. A fragment is tested once against the shadow map of each light; "
        "a voxel holds the mean of its lit fragments, and is opaque with any fragment. "
        "Each frame updates what scrolled in, where surfaces moved, and all if a light moved. "
        "As published in Arnebäck 2017 (sections 4.1 and 4.2), for comparison: "
        "use voxelize_clipmap and light_clipmap instead. Point, spot and directional lights; "
        "no bounces, no emissive surfaces. Biased by: voxel size, so distance from the camera; "
        "surfaces between samples, which are missed; shadow_resolution; "
        "shadows of what moves, which change only where surfaces move. "
        "Noisy by: nothing, but means of half floats depend on the order of threads by a few steps. "
        "Source: Arnebäck 2017, section 4.2.";
    struct Params : ClipmapParams {
        uint32_t resolution = 128;
        uint32_t shadowResolution = 512;
        bool light = true;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{field("resolution", &Params::resolution,
                                 "Voxels of the finest level along the scene's longest axis, "
                                 "if its window were the whole scene.",
                                 1u, 1024u),
                           field("shadow_resolution", &Params::shadowResolution,
                                 "Texels along an edge of each shadow map; a point light has six.", 2u, 4096u),
                           field("light", &Params::light,
                                 "Whether fragments are lit. Off: opacity alone, "
                                 "to time voxelization as the thesis does (section 5.3.1).")},
                ClipmapParams::schema());
        }
    };
    explicit RasterizeClipmap(const Params& params) : params_(params) {}

    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override { storage_.prepare(setup, setup[radiance_]); }
    void record(PassContext& context) override;

 private:
    /// Rasterizes the voxels of boxes in a level's window. @param grid of the level
    void rasterize(PassContext& context, uint32_t level, const gpu::VoxelGrid& grid,
                   const std::vector<VoxelBox>& boxes);

    const Params params_;
    Out<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales"};
    gpu::VoxelGrid finest_{};  ///< Of the whole scene.
    RadianceClipmap storage_;
    std::vector<LightSource> sources_;
    ShadowMaps shadowMaps_{*this};
    std::unique_ptr<TriangleVoxelizer> voxelizer_ = makeSampledAxisVoxelizer(8);
    std::unique_ptr<PassProgram> lightFragments_ =
        voxelizer_->makeProgram(*this, "passes/published/arneback_2017/rasterize_clipmap/light_fragments",
                                params_.light ? Defines{} : Defines{{"UNLIT", "1"}});
    Kernel openVoxels_{*this, "open_voxels.comp"};
    Kernel storeVoxels_{*this, "store_voxels.comp"};
    Buffer litVoxels_;  ///< 64 bits each of a level's voxels that are rasterized (lit_voxels.glsl).
    // Of the last frame:
    std::vector<gpu::ClipmapWindow> windows_;  ///< By level.
    std::vector<Light> lights_;
    uint64_t sceneVersion_ = 0;
};

void RasterizeClipmap::plan(PassPlan& plan) {
    const SceneState& scene = *plan.frame.scene;
    requireClearPanes(scene, kName);
    if (!plan.device.shaderInt64Atomics)
        throw Error("{}: device '{}' lacks 64-bit atomics on buffers (shaderBufferInt64Atomics)", kName,
                    plan.device.name);
    voxelizer_->plan(plan);
    sources_ = requirePunctualLights(scene, kName);
    if (params_.light) shadowMaps_.plan(plan, sources_, params_.shadowResolution);

    finest_ = makeVoxelGrid(scene.geometry.region.min, scene.geometry.region.max, params_.resolution);
    RadianceVoxels& radiance = plan[radiance_];
    radiance.lightBounces = 1;
    radiance.layout = RadianceLayout::ClipmapTextures;
    radiance.euclidean = true;
    radiance.grid = {finest_.origin,     finest_.voxelSize,
                     finest_.resolution, clipmapLevels(finest_.resolution, params_, kName),
                     /*directions=*/1,   radianceUnit(scene)};
    storage_ = RadianceClipmap(radiance.grid, params_.clipmapResolution);
    storage_.plan(plan, kName, radiance, "use voxelize_clipmap and light_clipmap");
    const gpu::VoxelGrid largest = levelGrid(finest_, 0, params_.clipmapResolution);
    plan.scratchBuffer(litVoxels_, "voxels that are rasterized", windowVoxels(largest).count() * sizeof(uint64_t));
    storeVoxels_.define(radiance.defines());
}

void RasterizeClipmap::record(PassContext& context) {
    const Frame& frame = context.frame;
    const std::vector<gpu::ClipmapWindow> windows = storage_.moveWindows(context, context[radiance_]);

    // A light that moved changes light anywhere; of surfaces that moved the thesis updates their boxes alone
    const bool moved = windows_.empty() || frame.sceneVersion != sceneVersion_;
    const bool changesAreKnown = !moved || (frame.sceneVersion == sceneVersion_ + 1 && frame.changedRegions);
    const bool all =
        windows_.empty() || !changesAreKnown || !std::ranges::equal(frame.scene->lights, lights_, isSameLight);
    if (moved && params_.light) shadowMaps_.draw(context, sources_);

    uint64_t updated = 0;
    for (uint32_t level = 0; level < windows.size(); ++level) {
        gpu::VoxelGrid grid = levelGrid(finest_, level, params_.clipmapResolution);
        grid.first = windows[level].first;
        std::vector<VoxelBox> boxes{windowVoxels(grid)};
        if (!all) {
            boxes = scrolledIn(windows_[level], windows[level]);
            if (moved) std::ranges::copy(changedVoxels(grid, *frame.changedRegions), std::back_inserter(boxes));
        }
        if (!boxes.empty()) rasterize(context, level, grid, boxes);
        for (const VoxelBox& box : boxes) updated += box.count();
    }
    context.report(kUpdatedVoxels, double(updated));
    windows_ = windows;
    lights_ = frame.scene->lights;
    sceneVersion_ = frame.sceneVersion;
}

void RasterizeClipmap::rasterize(PassContext& context, uint32_t level, const gpu::VoxelGrid& grid,
                                 const std::vector<VoxelBox>& boxes) {
    CommandStream& stream = context.stream;
    const RadianceVoxels& radiance = context[radiance_];
    const gpu::VoxelGrid drawn = gridOfBoxes(grid, boxes);
    const auto forEachBox = [&](const Kernel& kernel, const Bindings& bindings) {
        for (const VoxelBox& box : boxes)
            context.dispatch(kernel, box.count(),
                             {bindings.all(),
                              {"litVoxels", litVoxels_},
                              {"first", drawn.first},
                              {"end", drawn.resolution},
                              {"boxFirst", box.first},
                              {"boxSize", box.size},
                              {"level", level}});
    };

    // Empty the boxes' voxels, rasterize the triangles that reach them, and store their means
    stream.fill(litVoxels_, ~0u);
    forEachBox(openVoxels_, {});
    const std::vector<uint32_t> triangles = VoxelRegion(grid, enlarged(boxes)).triangles(context.frame.scene->geometry);
    if (!triangles.empty() && glm::all(glm::lessThan(drawn.first, glm::ivec3(drawn.resolution)))) {
        voxelizer_->select(context, grid, VoxelRegion(grid, boxes), triangles);
        std::vector<Binding> bindings{{"litVoxels", litVoxels_}};
        if (params_.light) std::ranges::copy(shadowMaps_.bindings(), std::back_inserter(bindings));
        voxelizer_->run(context, *lightFragments_, drawn, bindings, 1 / radiance.grid.unit);
    }
    forEachBox(storeVoxels_, {radiance.fillBindings()});
}

VOXRAY_REGISTER_PASS(RasterizeClipmap);

}  // namespace voxray
