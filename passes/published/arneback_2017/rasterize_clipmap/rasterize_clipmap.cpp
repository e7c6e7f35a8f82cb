#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <optional>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/lights/shadow_map.h"
#include "passes/common/triangle_voxelizer/level_voxelizer.h"
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

/// A part of a level that is rasterized.
struct LevelUpdate {
    uint32_t level;
    gpu::VoxelGrid grid;          ///< Of the level's window.
    std::vector<VoxelBox> boxes;  ///< In it.
    gpu::VoxelGrid drawn;         ///< Their bounds: from drawn.first up to drawn.resolution.
    uint32_t firstVoxel;          ///< Of the window, among the voxels that are rasterized at once.

    std::vector<uint32_t> triangles(const Geometry& geometry) const {
        const bool isEmpty = glm::any(glm::greaterThanEqual(drawn.first, glm::ivec3(drawn.resolution)));
        return isEmpty ? std::vector<uint32_t>() : VoxelRegion(grid, enlarged(boxes)).triangles(geometry);
    }
};

/// Triangles that reach any of the levels, each once.
std::vector<uint32_t> trianglesOf(const std::vector<LevelUpdate>& updates, const Geometry& geometry) {
    if (updates.size() == 1) return updates.front().triangles(geometry);
    std::vector<bool> isReached(geometry.triangles.size());
    for (const LevelUpdate& update : updates)
        for (const uint32_t triangle : update.triangles(geometry)) isReached[triangle] = true;
    std::vector<uint32_t> reached;
    for (uint32_t i = 0; i < isReached.size(); ++i)
        if (isReached[i]) reached.push_back(i);
    return reached;
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
        bool instanced = false;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{
                    field("resolution", &Params::resolution,
                          "Voxels of the finest level along the scene's longest axis, "
                          "if its window were the whole scene.",
                          1u, 1024u),
                    field("shadow_resolution", &Params::shadowResolution,
                          "Texels along an edge of each shadow map; a point light has six.", 2u, 4096u),
                    field("light", &Params::light,
                          "Whether fragments are lit. Off: opacity alone, "
                          "to time voxelization as the thesis does (section 5.3.1)."),
                    field("instanced", &Params::instanced,
                          "Whether one draw rasterizes all levels, as in the thesis (section 4.2): "
                          "an instance of each triangle and a viewport for each level. "
                          "Off: a draw for each level, of the triangles that reach it. The voxels are the same.")},
                ClipmapParams::schema());
        }
    };
    explicit RasterizeClipmap(const Params& params) : params_(params) {
        const std::string shader = "passes/published/arneback_2017/rasterize_clipmap/light_fragments";
        const Defines defines = params_.light ? Defines{} : Defines{{"UNLIT", "1"}};
        if (params_.instanced)
            levelVoxelizer_.emplace(*this, shader, defines);
        else
            lightFragments_ = voxelizer_->makeProgram(*this, shader, defines);
    }

    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override { storage_.prepare(setup, setup[radiance_]); }
    void record(PassContext& context) override;

 private:
    /// Which voxels of each level this frame rasterizes.
    std::vector<LevelUpdate> levelUpdates(const Frame& frame, const std::vector<gpu::ClipmapWindow>& windows,
                                          bool moved) const;
    /// Rasterizes and stores voxels of levels: of one, or of all by one draw.
    void rasterize(PassContext& context, const std::vector<LevelUpdate>& updates);
    void drawTriangles(PassContext& context, const std::vector<LevelUpdate>& updates);

    const Params params_;
    Out<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales"};
    gpu::VoxelGrid finest_{};  ///< Of the whole scene.
    RadianceClipmap storage_;
    std::vector<LightSource> sources_;
    ShadowMaps shadowMaps_{*this};
    std::unique_ptr<TriangleVoxelizer> voxelizer_ = makeSampledAxisVoxelizer(8);
    std::unique_ptr<PassProgram> lightFragments_;
    std::optional<LevelVoxelizer> levelVoxelizer_;  ///< In place of the two above, with `instanced`.
    Kernel openVoxels_{*this, "open_voxels.comp"};
    Kernel storeVoxels_{*this, "store_voxels.comp"};
    Buffer litVoxels_;    ///< 64 bits each of the voxels that are rasterized at once (lit_voxels.glsl).
    Buffer firstVoxels_;  ///< By level, with `instanced`: its first voxel among these.
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
    uint64_t voxels = storage_.windows().voxels();
    if (levelVoxelizer_) {
        levelVoxelizer_->plan(plan, radiance.grid.levels);
        plan.scratchBuffer(firstVoxels_, "first voxels of levels", radiance.grid.levels * sizeof(uint32_t));
    } else {
        voxelizer_->plan(plan);
        voxels = windowVoxels(levelGrid(finest_, 0, params_.clipmapResolution)).count();
    }
    plan.scratchBuffer(litVoxels_, "voxels that are rasterized", voxels * sizeof(uint64_t));
    storeVoxels_.define(radiance.defines());
}

std::vector<LevelUpdate> RasterizeClipmap::levelUpdates(const Frame& frame,
                                                        const std::vector<gpu::ClipmapWindow>& windows,
                                                        bool moved) const {
    // A light that moved changes light anywhere; of surfaces that moved the thesis updates their boxes alone
    const bool changesAreKnown = !moved || (frame.sceneVersion == sceneVersion_ + 1 && frame.changedRegions);
    const bool all =
        windows_.empty() || !changesAreKnown || !std::ranges::equal(frame.scene->lights, lights_, isSameLight);
    std::vector<LevelUpdate> updates;
    for (uint32_t level = 0; level < windows.size(); ++level) {
        gpu::VoxelGrid grid = levelGrid(finest_, level, params_.clipmapResolution);
        grid.first = windows[level].first;
        std::vector<VoxelBox> boxes{windowVoxels(grid)};
        if (!all) {
            boxes = scrolledIn(windows_[level], windows[level]);
            if (moved) std::ranges::copy(changedVoxels(grid, *frame.changedRegions), std::back_inserter(boxes));
        }
        gpu::VoxelGrid drawn = grid;
        drawn.resolution = glm::uvec3(0);  // Nothing
        if (!boxes.empty()) drawn = gridOfBoxes(grid, boxes);
        updates.push_back({level, grid, std::move(boxes), drawn, levelVoxelizer_ ? windows[level].firstIndex : 0});
    }
    return updates;
}

void RasterizeClipmap::record(PassContext& context) {
    const Frame& frame = context.frame;
    const std::vector<gpu::ClipmapWindow> windows = storage_.moveWindows(context, context[radiance_]);
    const bool moved = windows_.empty() || frame.sceneVersion != sceneVersion_;
    const std::vector<LevelUpdate> updates = levelUpdates(frame, windows, moved);
    if (moved && params_.light) shadowMaps_.draw(context, sources_);

    uint64_t updated = 0;
    for (const LevelUpdate& update : updates)
        for (const VoxelBox& box : update.boxes) updated += box.count();
    context.report(kUpdatedVoxels, double(updated));
    if (levelVoxelizer_ && updated > 0) rasterize(context, updates);
    if (!levelVoxelizer_)
        for (const LevelUpdate& update : updates)
            if (!update.boxes.empty()) rasterize(context, {update});
    windows_ = windows;
    lights_ = frame.scene->lights;
    sceneVersion_ = frame.sceneVersion;
}

void RasterizeClipmap::rasterize(PassContext& context, const std::vector<LevelUpdate>& updates) {
    const auto forEachBox = [&](const Kernel& kernel, const Bindings& bindings) {
        for (const LevelUpdate& update : updates)
            for (const VoxelBox& box : update.boxes)
                context.dispatch(kernel, box.count(),
                                 {bindings.all(),
                                  {"litVoxels", litVoxels_},
                                  {"first", update.drawn.first},
                                  {"end", update.drawn.resolution},
                                  {"boxFirst", box.first},
                                  {"boxSize", box.size},
                                  {"level", update.level},
                                  {"firstVoxel", update.firstVoxel}});
    };
    // Empty the boxes' voxels, rasterize the triangles that reach them, and store their means
    context.stream.fill(litVoxels_, ~0u);
    forEachBox(openVoxels_, {});
    drawTriangles(context, updates);
    forEachBox(storeVoxels_, {context[radiance_].fillBindings()});
}

void RasterizeClipmap::drawTriangles(PassContext& context, const std::vector<LevelUpdate>& updates) {
    const Geometry& geometry = context.frame.scene->geometry;
    const std::vector<uint32_t> triangles = trianglesOf(updates, geometry);
    if (triangles.empty()) return;
    const float scale = 1 / context[radiance_].grid.unit;
    std::vector<Binding> bindings{{"litVoxels", litVoxels_}};
    if (params_.light) std::ranges::copy(shadowMaps_.bindings(), std::back_inserter(bindings));
    if (!levelVoxelizer_) {
        const LevelUpdate& update = updates.front();
        voxelizer_->select(context, update.grid, VoxelRegion(update.grid, update.boxes), triangles);
        voxelizer_->run(context, *lightFragments_, update.drawn, bindings, scale);
        return;
    }
    std::vector<gpu::VoxelGrid> grids;
    std::vector<uint32_t> firstVoxels;
    for (const LevelUpdate& update : updates) {
        grids.push_back(update.drawn);
        firstVoxels.push_back(update.firstVoxel);
    }
    context.stream.upload(firstVoxels_, firstVoxels);
    bindings.emplace_back("firstVoxels", firstVoxels_);
    levelVoxelizer_->run(context, grids, triangles, bindings, scale);
}

VOXRAY_REGISTER_PASS(RasterizeClipmap);

}  // namespace voxray
