#include "passes/vpls/gather_vpls/imperfect_shadow_maps.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "passes/vpls/gather_vpls/map_point_types.h"
#include "scene/region_split.h"

namespace voxray {
namespace {

constexpr uint32_t kPointSets = 16;  // Adjacent maps use different sets.
constexpr uint32_t kMaxSplats = 1u << 31;

/// Cumulative area of the triangles in the region, up to and including each, over the total.
std::vector<float> areaCdf(const Geometry& g) {
    std::vector<float> cdf;
    cdf.reserve(g.triangles.size());
    double total = 0;
    for (uint32_t t = 0; t < g.triangles.size(); ++t)
        cdf.push_back(float(total += isInRegion(g, t) ? triangleArea(g, t) : 0.0));
    for (float& area : cdf) area = float(area / total);
    return cdf;
}

}  // namespace

ImperfectShadowMaps::ImperfectShadowMaps(ProgramOwner& owner, uint32_t resolution, uint32_t pointsPerMap)
    : VplShadowMaps(resolution, std::min(kTexels / (resolution * resolution), kMaxSplats / pointsPerMap)),
      pointsPerMap_(pointsPerMap),
      samplePoints_(owner, "ism_sample_points.comp"),
      splat_(owner, "ism_splat.comp"),
      pull_(owner, "ism_pull.comp"),
      push_(owner, "ism_push.comp") {}

void ImperfectShadowMaps::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    area_ = float(surfaceArea(geometry));
    plan.buffer(areaCdf_, "areas of triangles", geometry.triangles.size() * sizeof(float));
    plan.buffer(pointSets_, "points of shadow maps", uint64_t(kPointSets) * pointsPerMap_ * sizeof(gpu::MapPoint));
    for (uint32_t level = 0; level < kLevels; ++level)
        plan.buffer(levels_[level], level == 0 ? "shadow maps" : "coarser shadow maps",
                    uint64_t(capacity()) * levelResolution(level) * levelResolution(level) * sizeof(float));
}

void ImperfectShadowMaps::beginFrame(PassContext& context, const Vpls&) {
    if (sceneVersion_ == context.frame.sceneVersion) return;
    sceneVersion_ = context.frame.sceneVersion;
    const Geometry& geometry = context.frame.scene->geometry;
    context.stream.upload(areaCdf_, areaCdf(geometry));
    context.dispatch(samplePoints_, kPointSets * pointsPerMap_,
                     {context.scene,
                      {"areaCdf", areaCdf_},
                      {"points", pointSets_},
                      {"count", kPointSets * pointsPerMap_},
                      {"triangleCount", uint32_t(geometry.triangles.size())}});
}

void ImperfectShadowMaps::render(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const {
    context.stream.fill(levels_[0], 0);
    // A disc has the area of its share of all surfaces
    const float radius = std::sqrt(area_ / (glm::pi<float>() * float(pointsPerMap_)));
    context.dispatch(splat_, count * pointsPerMap_,
                     {context.scene,
                      {"VplsRef", vpls.points.ref()},
                      {"activeVpls", vpls.activeIndices},
                      {"points", pointSets_},
                      {"maps", levels_[0]},
                      {"firstVpl", first},
                      {"vplCount", count},
                      {"pointsPerMap", pointsPerMap_},
                      {"setCount", kPointSets},
                      {"resolution", resolution()},
                      {"radius", radius}});

    // Fill holes: pull from fine to coarse, then push back
    const auto filter = [&](const Kernel& kernel, uint32_t fine, uint32_t outputResolution) {
        context.dispatch(kernel, uint64_t(count) * outputResolution * outputResolution,
                         {{"fine", levels_[fine]},
                          {"coarse", levels_[fine + 1]},
                          {"fineResolution", levelResolution(fine)},
                          {"coarseResolution", levelResolution(fine + 1)},
                          {"mapCount", count}});
    };
    for (uint32_t level = 0; level + 1 < kLevels; ++level) filter(pull_, level, levelResolution(level + 1));
    for (uint32_t level = kLevels - 1; level-- > 0;) filter(push_, level, levelResolution(level));
}

}  // namespace voxray
