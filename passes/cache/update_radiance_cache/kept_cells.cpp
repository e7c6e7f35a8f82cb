#include "passes/cache/update_radiance_cache/kept_cells.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace voxray {

KeptCells::KeptCells(Pass& pass, const Params& params)
    : params_(params),
      gbuffer_(pass, "gbuffer", "where the gather rays start"),
      hits_(pass, "gather_hits", "where the gather rays hit"),
      gatherFaces_(pass, FaceKind::Cells),
      newFaces_(pass, FaceKind::Cells),
      batch_(pass),
      kept_(pass, {params.pointsPerCell, params.bounces, params.raysPerPixel, FaceKind::Cells}),
      write_(pass, "write_kept_cells.comp", definesOf(FaceKind::Cells)) {}

void KeptCells::plan(PassPlan& plan, std::vector<LightSource> sources) {
    const uint64_t rays = gatherFaces_.plan(plan, plan[hits_]);
    batch_.plan(plan, std::move(sources), params_.lightSamples, rays);
    plan.buffer(lost_, "number of lost rays", sizeof(uint32_t));
    // Surfaces all around the camera: edges are evenly distributed in logarithm between the largest and half of that,
    // the mean of 1 / edge² is 1.5 / ln 2 of that of the largest
    constexpr double kCellsOfLargest = 1.5 / std::numbers::ln2;
    const double cells =
        std::min(4 * std::numbers::pi * kCellsOfLargest / (double(params_.cellSize) * params_.cellSize),
                 double(params_.capacity));
    plan.estimate(params_.capacity * sizeof(uint32_t) +
                  cells * (KeptFaces::kBytesPerFace + params_.pointsPerCell * KeptFaces::kBytesPerPoint));
}

void KeptCells::update(PassContext& context, RadianceCache& cache, const gpu::RadianceCacheGrid& grid) {
    CommandStream& stream = context.stream;
    const Frame& frame = context.frame;
    stream.upload(cache.gridBuffer, std::vector{grid});
    const bool onlyLightChanged = frame.changedRegions && frame.changedRegions->empty();
    if (!sceneVersion_ || (*sceneVersion_ != frame.sceneVersion && !onlyLightChanged)) {
        stream.fill(cache.keys, 0);
        kept_.clear(context, grid.capacity, light_);
    }
    sceneVersion_ = frame.sceneVersion;
    stream.fill(lost_, 0);
    newFaces_.begin(context, grid.capacity, &cache.keys);
    const std::vector<FaceHits> hits =
        gatherFaces_.mark(context, context[hits_], context[gbuffer_], cache.bindings(), light_, newFaces_);
    kept_.update(context, {cache.bindings(), cache.bindings()}, light_, newFaces_, batch_, hits, lost_);
    context.dispatch(write_, grid.capacity, {cache, light_, {"irradiance", light_.irradiance}});
    context.report("occupancy", double(kept_.faces()) / grid.capacity);
    context.report("samples lost", stream.readAs<uint32_t>(lost_, 1)[0]);
}

}  // namespace voxray
