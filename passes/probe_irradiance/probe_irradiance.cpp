#include "passes/probe_irradiance/probe_irradiance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct GatherPush {
    uint32_t surfels;
    uint32_t stride;
    uint32_t cones;
    uint32_t samples;
};

/// Rec. 709, as the metrics have it.
double luminance(const glm::vec4& c) {
    return glm::dot(glm::dvec3(c), glm::dvec3(0.2126, 0.7152, 0.0722));
}

}  // namespace

void ProbeIrradiance::declare(PassBuilder& builder) {
    surfels_ = builder.read<Surfels>("surfels", "points on surfaces, some of which are probed");
    radiance_ = builder.read<RadianceVoxels>("radiance", "light that leaves surfaces, at all scales");
}

uint32_t ProbeIrradiance::stride(const Surfels& surfels) const {
    return uint32_t((surfels.maxCount + params_.maxPoints - 1) / params_.maxPoints) | 1u;
}

void ProbeIrradiance::plan(PassPlan& plan) {
    if (!movingRuns(plan.frame.scene->geometry).empty())
        throw Error(
            "{}: surfaces move, and with them the points that it would compare; set scene.time_step to 0 and "
            "take "
            "out scene.moving_spheres",
            kName);
    plan.buffer(cones_, "cones", coneSet(params_.cones).size() * sizeof(gpu::Cone));
    const Surfels& surfels = plan.get(surfels_);
    plan.buffer(irradiance_, "irradiance of points",
                (surfels.maxCount / stride(surfels) + 1) * sizeof(glm::vec4));
}

void ProbeIrradiance::prepare(PassSetup& setup) {
    setup.stream.upload(cones_, coneSet(params_.cones));
    gather_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/probe_irradiance/gather.comp",
                                                                      setup.get(radiance_).defines()));
    last_.clear();
}

void ProbeIrradiance::record(PassContext& context) {
    // Gather at the points.
    const Surfels& surfels = context.get(surfels_);
    context.stream.fill(irradiance_, 0);
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        std::vector<Binding> bindings = context.get(radiance_).bindings();
        bindings.insert(bindings.end(),
                        {{"cones", cones_}, {"surfels", chunk.surfels}, {"irradiance", irradiance_}});
        context.stream.dispatch(gather_, bindings,
                                GatherPush{chunk.count, stride(surfels), params_.cones, params_.coneSets},
                                linearGroups(chunk.count));
    }
    const std::vector<glm::vec4> now =
        context.stream.readAs<glm::vec4>(irradiance_, irradiance_.bytes() / sizeof(glm::vec4));

    // Compare with the last frame.
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

}  // namespace voxray
