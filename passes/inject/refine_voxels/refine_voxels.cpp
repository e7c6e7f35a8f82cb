#include <algorithm>
#include <bit>
#include <cmath>
#include <list>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/bit_words.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/voxel_builder/voxel_builder.h"
#include "passes/common/voxels/level_join.h"
#include "passes/inject/light_paths/light_emission.h"
#include "passes/inject/light_paths/light_paths.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxResolution = 1024;     // As voxelize's.
constexpr uint32_t kBlock = 8;                // Voxels along an edge of a block whose mean irradiance is the scale.
constexpr uint32_t kMaxBatchRays = 1u << 20;  // Bounds the memory of rays to 108 MiB.

/// The grid with twice as many voxels along each axis.
gpu::VoxelGrid finerGrid(gpu::VoxelGrid grid) {
    grid.voxelSize /= 2;
    grid.resolution *= 2u;
    grid.windowSize *= 2;
    grid.wordsPerRow = uint32_t(bitWords(grid.resolution.x));
    return grid;
}

gpu::VoxelGrid finestGrid(gpu::VoxelGrid grid, uint32_t levels) {
    for (uint32_t i = 0; i < levels; ++i) grid = finerGrid(grid);
    return grid;
}

}  // namespace

/// Splits surface voxels where a single value errs by more than its noise, level by level: all candidates are split,
/// two halves of the light rays light them, and those stay split whose halves agree on a difference. Docs:
/// docs/refined-voxels.md.
class RefineVoxels final : public Pass {
 public:
    static constexpr const char* kName = "refine_voxels";
    static constexpr const char* kHelp =
        "Splits voxels in which light differs by more than its noise. "
        "Light rays light each level's voxels, halves of the rays apart; voxels stay split where that lowers the "
        "squared error. Read by inject_light_rays, gather_irradiance and gather_rays. "
        "Biased by: voxel size, and tolerance. Noisy by: rays_per_light. "
        "Source: Breiman et al. 1984, chapter 3 (splits by error), on an octree's levels.";
    struct Params {
        uint32_t levels = 2;
        float tolerance = 0.1f;
        uint32_t raysPerLight = 4194304;
        uint32_t trialBounces = 8;
        uint32_t visibilityRays = 8;
        static constexpr auto schema() {
            return std::tuple{
                field("levels", &Params::levels, "How often a voxel may be split: its parts are 1/2^levels as wide.",
                      1u, 3u),
                field("tolerance", &Params::tolerance,
                      "Error of irradiance that a voxel's face may have, relative to the mean around it; of parts of "
                      "voxels by the square root of their area.",
                      0.0f, 100.0f),
                field("rays_per_light", &Params::raysPerLight,
                      "Light rays that find out what to split, at each level, in two halves; from each light as "
                      "inject_light_rays counts them. Take as many as there.",
                      2u, 1u << 26)
                    .lessNoise(),
                field("trial_bounces", &Params::trialBounces, "Bounces of these rays after the first hit.", 0u, 64u),
                field("visibility_rays", &Params::visibilityRays, "As voxelize has it, for parts of voxels.", 0u,
                      256u)};
        }
    };

    explicit RefineVoxels(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    using Halves = std::array<VoxelIrradiance, 2>;

    /// Voxels from the coarsest level on, and bits of those that are split, of all levels but the finest.
    struct Levels {
        std::vector<const SurfaceVoxels*> voxels;
        std::list<SurfaceVoxels> split;  ///< All of `voxels` but the coarsest.
        std::vector<Buffer> splitBits;
    };

    static LightPathParams pathParams(const Params& params) {
        LightPathParams paths;
        paths.bounces = params.trialBounces;
        return paths;
    }
    /// Splits all voxels of the finest level.
    void addLevel(PassContext& context, Levels& levels);
    void join(PassContext& context, const Levels& levels) const;
    Halves light(PassContext& context, uint32_t round);
    /// Undoes splits that do not lower the error. @return the number of those that stay.
    uint32_t choose(PassContext& context, const Levels& levels, const Halves& halves) const;
    /// Mean irradiance by block, squared.
    void measureMeans(PassContext& context, const Halves& halves) const;
    Bindings lightBindings(PassContext& context, const Halves& halves) const;

    const Params params_;
    In<SurfaceVoxels> coarse_{*this, "voxels", "surface voxels to split"};
    Out<VoxelLevels> voxels_{*this, "voxels", "surface voxels of all levels, numbered through"};
    VoxelBuilder builder_{*this, makeExactVoxelizer(), params_.visibilityRays};
    KeepChildren keepChildren_{*this};
    LevelJoin join_{*this};
    LightEmission emission_{*this};
    LightPaths paths_{*this, pathParams(params_)};
    Kernel measureMeans_{*this, "mean_irradiance.comp", {{"BLOCK", std::to_string(kBlock)}}};
    Kernel chooseSplits_{*this, "choose_splits.comp"};
    glm::uvec3 blocks_{};
    Buffer means_, count_;       ///< Scratch: by block; number of voxels that stay split.
    uint64_t sceneVersion_ = 0;  ///< Of the last run.
};

void RefineVoxels::plan(PassPlan& plan) {
    const SurfaceVoxels& coarse = plan[coarse_];
    const glm::uvec3 resolution = coarse.grid.resolution;
    const uint32_t longest = std::max({resolution.x, resolution.y, resolution.z}), finest = longest << params_.levels;
    if (finest > kMaxResolution)
        throw Error(
            "{}: 'levels: {}' makes a grid of {} voxels along its longest side, more than {}; lower 'levels' or "
            "voxelize's 'resolution'",
            kName, params_.levels, finest, kMaxResolution);
    if (coarse.areasAreUnoccluded != (params_.visibilityRays > 0))
        throw Error("{}: 'visibility_rays' of voxelize is 0 and its own is not, or the other way round; set both alike",
                    kName);
    const std::vector<LightSource> sources = requireLightSources(*plan.frame.scene, kName);
    VoxelLevels& voxels = plan[voxels_];
    voxels.grid = finestGrid(coarse.grid, params_.levels);
    voxels.areasAreUnoccluded = coarse.areasAreUnoccluded;
    blocks_ = (resolution + (kBlock - 1)) / kBlock;
    plan.scratchBuffer(means_, "mean irradiance of blocks",
                       uint64_t(blocks_.x) * blocks_.y * blocks_.z * sizeof(float));
    plan.scratchBuffer(count_, "number of split voxels", sizeof(uint32_t));
    builder_.planWork(plan);
    const uint32_t batch = std::min(params_.raysPerLight / 2, kMaxBatchRays);
    // Estimates no light: that of the halves is freed
    paths_.plan(plan, kName, batch, voxels, sources);
    emission_.plan(plan, batch);
    voxels.estimatedCount = coarse.estimatedCount;  // What is split is known when light is
    uint64_t words = 0;
    for (uint32_t i = 0; i <= params_.levels; ++i) words += occupancyWords(finestGrid(coarse.grid, i));
    plan.estimate(2.0 * double(words) * sizeof(uint32_t) + voxels.estimatedCount * kAreaWords * sizeof(uint32_t));
    plan.lightRays = uint64_t(params_.levels) * params_.raysPerLight * (params_.trialBounces + 1) * sources.size();
}

void RefineVoxels::addLevel(PassContext& context, Levels& levels) {
    const SurfaceVoxels& parents = *levels.voxels.back();
    Buffer bits(context.device, "split voxels", parents.words() * sizeof(uint32_t));
    context.stream.copy(parents.occupancy, bits, bits.bytes());
    if (!levels.splitBits.empty())
        keepChildren_.run(context.stream, parents.grid, bits, levels.voxels[levels.voxels.size() - 2]->grid,
                          levels.splitBits.back());
    SurfaceVoxels& parts = levels.split.emplace_back();
    parts.grid = finerGrid(parents.grid);
    parts.areasAreUnoccluded = parents.areasAreUnoccluded;
    parts.occupancy = Buffer(context.device, "voxel occupancy", parts.words() * sizeof(uint32_t));
    parts.rank = Buffer(context.device, "voxel ranks", parts.words() * sizeof(uint32_t));
    builder_.buildWithin(context, parents.grid, bits, parts);
    levels.splitBits.push_back(std::move(bits));
    levels.voxels.push_back(&parts);
}

void RefineVoxels::join(PassContext& context, const Levels& levels) const {
    std::vector<LevelSource> sources;
    for (size_t l = levels.voxels.size(); l-- > 0;)
        sources.push_back({wholeLevel(levels.voxels[l]->grid), levels.voxels[l],
                           l < levels.splitBits.size() ? &levels.splitBits[l] : nullptr});
    join_.run(context, sources, context[voxels_]);
}

RefineVoxels::Halves RefineVoxels::light(PassContext& context, uint32_t round) {
    const VoxelLevels& voxels = context[voxels_];
    const std::vector<LightSource> sources = lightSources(*context.frame.scene);
    const uint32_t rays = params_.raysPerLight / 2, sourceCount = uint32_t(sources.size());
    Halves halves;
    for (uint32_t h = 0; h < halves.size(); ++h) {
        paths_.begin(context, voxels, sources);
        for (uint32_t s = 0; s < sourceCount; ++s) {
            // The first numbers are those of inject_light_rays, whose rays are others
            const uint32_t seed = randomSeed(context.frame, sourceCount * (1 + 2 * round + h) + s);
            for (uint32_t first = 0; first < rays; first += kMaxBatchRays) {
                const uint32_t count = std::min(kMaxBatchRays, rays - first);
                emission_.emit(context, sources[s], {seed, rays, first, count}, paths_.rays(), paths_.paths());
                paths_.trace(context, voxels, {seed, first, count});
            }
        }
        paths_.finish(context, voxels, halves[h]);
    }
    return halves;
}

Bindings RefineVoxels::lightBindings(PassContext& context, const Halves& halves) const {
    return {context[voxels_],
            {"DirectARef", halves[0].direct.ref()},
            {"IndirectARef", halves[0].indirect.ref()},
            {"DirectBRef", halves[1].direct.ref()},
            {"IndirectBRef", halves[1].indirect.ref()},
            {"area", context[voxels_].unoccludedArea},
            {"means", means_},
            {"blocks", blocks_}};
}

void RefineVoxels::measureMeans(PassContext& context, const Halves& halves) const {
    context.dispatch(measureMeans_, blocks_.x * blocks_.y * blocks_.z, lightBindings(context, halves));
}

uint32_t RefineVoxels::choose(PassContext& context, const Levels& levels, const Halves& halves) const {
    const uint32_t depth = uint32_t(levels.splitBits.size());
    const uint32_t words = uint32_t(levels.splitBits.back().bytes() / sizeof(uint32_t));
    context.stream.fill(count_, 0);
    context.dispatch(chooseSplits_, words,
                     {lightBindings(context, halves).all(),
                      {"split", levels.splitBits.back()},
                      {"count", count_},
                      {"blockShift", uint32_t(std::countr_zero(kBlock)) + depth - 1},
                      {"words", words},
                      {"faceArea", std::ldexp(1.0f, -2 * int(depth))},
                      {"tolerance2", params_.tolerance * params_.tolerance}});
    return context.stream.readAs<uint32_t>(count_, 1)[0];
}

void RefineVoxels::record(PassContext& context) {
    const uint64_t sceneVersion = context.frame.sceneVersion;
    if (!context.changed(coarse_) && sceneVersion_ == sceneVersion) return context.markOutputsUnchanged();
    sceneVersion_ = sceneVersion;
    Levels levels;
    levels.voxels.push_back(&context[coarse_]);
    for (uint32_t depth = 0; depth < params_.levels; ++depth) {
        addLevel(context, levels);
        join(context, levels);
        const Halves halves = light(context, depth);
        if (depth == 0) measureMeans(context, halves);
        const uint32_t count = choose(context, levels, halves);
        context.report("split voxels of level " + std::to_string(depth), count);
        if (count > 0) continue;
        levels.voxels.pop_back();
        levels.splitBits.pop_back();
        levels.split.pop_back();
        break;
    }
    join(context, levels);
    context.stream.finish();
    VoxelLevels& voxels = context[voxels_];
    voxels.grid = levels.voxels.back()->grid;
    context.report("voxels", voxels.voxelCount);
    context.report("bits and ranks of voxels, MiB", double(voxels.occupancy.bytes() + voxels.rank.bytes()) / (1 << 20));
}

VOXRAY_REGISTER_PASS(RefineVoxels);

}  // namespace voxray
