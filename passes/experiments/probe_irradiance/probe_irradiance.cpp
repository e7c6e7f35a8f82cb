#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/cones/radiance/cone_sets.h"
#include "passes/cones/radiance/radiance_voxels.h"
#include "passes/surfels/surfels.h"

namespace voxray {
namespace {

/// Rec. 709, as in the metrics.
double luminance(const glm::vec4& c) {
    return glm::dot(glm::dvec3(c), glm::dvec3(0.2126, 0.7152, 0.0722));
}

}  // namespace

/// Irradiance by cones at fixed points on surfaces, and its change from frame to frame. In a static scene
/// changes are artifacts of the method, such as clipmap levels that follow the camera, or windows that
/// scroll. A point has the same random numbers in every frame.
class ProbeIrradiance final : public Pass {
 public:
    static constexpr const char* kName = "probe_irradiance";
    static constexpr const char* kHelp =
        "Measures how stable irradiance is over frames, by cones at fixed points. The points are on static surfaces. "
        "For each frame it reports the mean irradiance (W/m²) and its change since the last frame relative "
        "to this mean: the average over points and the maximum. Tests stability: where only the camera moves, "
        "changes are artifacts of the method. Surfaces may not move, as points would lose their identity.";
    struct Params {
        uint32_t maxPoints = 1024;
        uint32_t cones = 6;
        uint32_t coneSets = 16;
        static constexpr auto schema() {
            return std::tuple{
                field("max_points", &Params::maxPoints,
                      "Maximum number of points, a subset of the surfels of place_surfels.", 1u, 1u << 20),
                field("cones", &Params::cones, "Cones from each point.", coneSetSizes()),
                field("cone_sets", &Params::coneSets,
                      "Sets of cones from each point, with different rotations and levels. "
                      "gather_cones traces one set per texel and averages over about 25 texels.",
                      1u, 256u)};
        }
    };
    explicit ProbeIrradiance(const Params& params) : params_(params) {}

    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    In<Surfels> surfels_{*this, "surfels", "points on surfaces, a subset of which is probed"};
    In<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales"};
    Kernel gather_{*this, "gather.comp"};
    Buffer cones_, irradiance_;
    std::vector<glm::vec4> last_;  ///< `irradiance_` in the previous frame.
};

void ProbeIrradiance::plan(PassPlan& plan) {
    if (!movingInstanceRanges(plan.frame.scene->geometry).empty())
        throw Error(
            "{}: surfaces move, and with them the points that it would compare; "
            "set scene.time_step to 0 and take out scene.moving_spheres",
            kName);
    plan.buffer(cones_, "cones", coneSet(params_.cones).size() * sizeof(gpu::Cone));
    gather_.define(plan[radiance_].defines());
}

void ProbeIrradiance::prepare(PassSetup& setup) {
    setup.stream.upload(cones_, coneSet(params_.cones));
}

void ProbeIrradiance::record(PassContext& context) {
    // Gather at every stride-th surfel by id. Each point of place_surfels has two ids, for the sides of its
    // surface; the odd stride alternates between them
    const Surfels& surfels = context[surfels_];
    const uint64_t ids = 2 * surfels.pointCount;
    const uint32_t stride = uint32_t((ids + params_.maxPoints - 1) / params_.maxPoints) | 1u;
    ensureSize(irradiance_, context.device, "irradiance of points", (ids / stride + 1) * sizeof(glm::vec4));
    if (context.changed(surfels_)) last_.clear();
    context.stream.fill(irradiance_, 0);
    for (const Surfels::Chunk& chunk : surfels.chunks)
        context.dispatch(gather_, chunk.count,
                         {context[radiance_],
                          {"cones", cones_},
                          {"surfels", chunk.surfels},
                          {"irradiance", irradiance_},
                          {"count", chunk.count},
                          {"stride", stride},
                          {"coneCount", params_.cones},
                          {"samples", params_.coneSets}});
    const std::vector<glm::vec4> now =
        context.stream.readAs<glm::vec4>(irradiance_, irradiance_.bytes() / sizeof(glm::vec4));

    // Compare with the previous frame
    double sum = 0, change = 0, largest = 0;
    uint64_t points = 0;
    for (size_t i = 0; i < now.size(); ++i) {
        if (now[i].w == 0) continue;
        ++points;
        sum += luminance(now[i]);
        if (last_.empty() || last_[i].w == 0) continue;
        const double difference = std::abs(luminance(now[i]) - luminance(last_[i]));
        change += difference;
        largest = std::max(largest, difference);
    }
    const double mean = points > 0 ? sum / double(points) : 0;
    context.report("mean irradiance", mean);
    if (!last_.empty() && mean > 0) {
        context.report("mean change", change / double(points) / mean);
        context.report("largest change", largest / mean);
    }
    last_ = now;
}

VOXRAY_REGISTER_PASS(ProbeIrradiance);

}  // namespace voxray
