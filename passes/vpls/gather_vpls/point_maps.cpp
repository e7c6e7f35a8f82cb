#include "passes/vpls/gather_vpls/point_maps.h"

#include <glm/gtc/constants.hpp>

#include "passes/common/lights/light_sources.h"
#include "passes/vpls/gather_vpls/map_point_types.h"
#include "scene/region_split.h"

namespace voxray {
namespace {

constexpr uint32_t kSets = 16;  // Of points; maps next to each other take other ones.

/// Area of all triangles of the region up to each one and with it, over that of all.
std::vector<float> areasUpTo(const Geometry& g) {
    std::vector<float> upTo;
    upTo.reserve(g.triangles.size());
    double sum = 0;
    for (uint32_t t = 0; t < g.triangles.size(); ++t)
        upTo.push_back(float(sum += isInRegion(g, t) ? double(triangleArea(g, g.triangles[t])) : 0.0));
    for (float& area : upTo) area = float(area / sum);
    return upTo;
}

}  // namespace

PointMaps::PointMaps(ProgramOwner& owner, uint32_t resolution, uint32_t points)
    : VplMaps(resolution),
      points_(points),
      spread_(owner, "points_spread.comp"),
      splat_(owner, "points_splat.comp"),
      pull_(owner, "points_pull.comp"),
      push_(owner, "points_push.comp") {}

void PointMaps::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    area_ = float(surfaceArea(geometry));
    plan.buffer(upTo_, "areas of triangles", geometry.triangles.size() * sizeof(float));
    plan.buffer(spreadPoints_, "points of shadow maps", uint64_t(kSets) * points_ * sizeof(gpu::MapPoint));
    for (uint32_t level = 0; level < kLevels; ++level)
        plan.buffer(levels_[level], level == 0 ? "shadow maps" : "coarser shadow maps",
                    uint64_t(capacity()) * side(level) * side(level) * sizeof(float));
}

void PointMaps::begin(PassContext& context) {
    if (version_ == context.frame.sceneVersion) return;
    version_ = context.frame.sceneVersion;
    const Geometry& geometry = context.frame.scene->geometry;
    context.stream.upload(upTo_, areasUpTo(geometry));
    context.dispatch(spread_, kSets * points_,
                     {context.scene,
                      {"upTo", upTo_},
                      {"points", spreadPoints_},
                      {"count", kSets * points_},
                      {"triangles", uint32_t(geometry.triangles.size())}});
}

void PointMaps::draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const {
    context.stream.fill(levels_[0], 0);
    // Each point stands for a disc of its part of all area
    const float radius = std::sqrt(area_ / (glm::pi<float>() * float(points_)));
    context.dispatch(splat_, count * points_,
                     {context.scene,
                      {"VplsAt", vpls.points.at()},
                      {"list", vpls.list},
                      {"points", spreadPoints_},
                      {"maps", levels_[0]},
                      {"firstVpl", first},
                      {"vplCount", count},
                      {"mapPoints", points_},
                      {"sets", kSets},
                      {"resolution", resolution()},
                      {"radius", radius}});

    // Holes: from fine to coarse, and back
    const auto step = [&](const Kernel& kernel, uint32_t fine, uint32_t ofSide) {
        context.dispatch(kernel, uint64_t(count) * ofSide * ofSide,
                         {{"fine", levels_[fine]},
                          {"coarse", levels_[fine + 1]},
                          {"fineSide", side(fine)},
                          {"coarseSide", side(fine + 1)},
                          {"maps", count}});
    };
    for (uint32_t level = 0; level + 1 < kLevels; ++level) step(pull_, level, side(level + 1));
    for (uint32_t level = kLevels - 1; level-- > 0;) step(push_, level, side(level));
}

}  // namespace voxray
