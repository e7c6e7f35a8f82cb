#include "passes/gather_vpls/point_maps.h"

#include <glm/gtc/constants.hpp>

#include "passes/common/compute/dispatch.h"
#include "passes/common/lights/light_sources.h"
#include "passes/gather_vpls/map_point_types.h"
#include "scene/region_split.h"

namespace voxray {
namespace {

constexpr uint32_t kSets = 16;  // Of points; maps next to each other take other ones.

struct SpreadPush {
    uint32_t points;
    uint32_t triangles;
};

struct SplatPush {
    uint32_t firstVpl, vplCount;
    uint32_t points, sets;
    uint32_t resolution;
    float radius;
};

struct LevelPush {
    uint32_t fineSide, coarseSide;
    uint32_t maps;
};

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

void PointMaps::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    area_ = float(surfaceArea(geometry));
    plan.buffer(upTo_, "areas of triangles", geometry.triangles.size() * sizeof(float));
    plan.buffer(spreadPoints_, "points of shadow maps", uint64_t(kSets) * points_ * sizeof(gpu::MapPoint));
    for (uint32_t level = 0; level < kLevels; ++level)
        plan.buffer(levels_[level], level == 0 ? "shadow maps" : "coarser shadow maps",
                    uint64_t(capacity()) * side(level) * side(level) * sizeof(float));
}

void PointMaps::prepare(PassSetup& setup) {
    const auto program = [&](const std::string& file) {
        return makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_vpls/" + file));
    };
    spread_ = program("points_spread.comp");
    splat_ = program("points_splat.comp");
    pull_ = program("points_pull.comp");
    push_ = program("points_push.comp");
    version_.reset();
}

void PointMaps::begin(PassContext& context) {
    if (version_ == context.frame.sceneVersion) return;
    version_ = context.frame.sceneVersion;
    const Geometry& geometry = context.frame.scene->geometry;
    context.stream.upload(upTo_, areasUpTo(geometry));
    context.stream.dispatch(spread_, context.scene.bindings({{"upTo", upTo_}, {"points", spreadPoints_}}),
                            SpreadPush{kSets * points_, uint32_t(geometry.triangles.size())},
                            linearGroups(kSets * points_));
}

void PointMaps::draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const {
    CommandStream& stream = context.stream;
    stream.fill(levels_[0], 0);
    // Each point stands for a disc of its part of all area
    const float radius = std::sqrt(area_ / (glm::pi<float>() * float(points_)));
    stream.dispatch(splat_,
                    context.scene.bindings({{"VplsAt", vpls.points.at()},
                                            {"list", vpls.list},
                                            {"points", spreadPoints_},
                                            {"maps", levels_[0]}}),
                    SplatPush{first, count, points_, kSets, resolution(), radius},
                    linearGroups(count * points_));

    // Holes: from fine to coarse, and back
    const auto step = [&](const Program& program, uint32_t fine, uint32_t ofSide) {
        stream.dispatch(program, {{"fine", levels_[fine]}, {"coarse", levels_[fine + 1]}},
                        LevelPush{side(fine), side(fine + 1), count},
                        linearGroups(uint64_t(count) * ofSide * ofSide));
    };
    for (uint32_t level = 0; level + 1 < kLevels; ++level) step(pull_, level, side(level + 1));
    for (uint32_t level = kLevels - 1; level-- > 0;) step(push_, level, side(level));
}

}  // namespace voxray
