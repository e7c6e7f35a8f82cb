#include "experiment/light_cost.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.h"
#include "trace/embree_scene.h"

namespace voxray {
namespace {

constexpr size_t kLights = 16;                ///< Fewer are not many.
constexpr uint64_t kMaxUnasked = 20'000'000;  ///< Rays that no machine takes long for.
constexpr double kLongSeconds = 10;
constexpr uint32_t kTimedRays = 1u << 16;

std::string duration(double seconds) {
    return seconds < 100 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60);
}

}  // namespace

double LightCost::raysPerSecond() {
    if (raysPerSecond_) return *raysPerSecond_;
    // From surfaces all over the scene to one light after the other.
    const Geometry& g = state_.geometry;
    std::vector<Ray> rays(kTimedRays);
    for (uint32_t i = 0; i < kTimedRays; ++i) {
        const glm::vec3 from = g.positions[g.triangles[uint64_t(i) * g.triangles.size() / kTimedRays].x];
        const Light& light = state_.lights[i % state_.lights.size()];
        const bool isFar = light.type == LightType::Directional;
        const glm::vec3 way = isFar ? -light.direction : light.position - from;
        rays[i] = {from, 1e-3f, way, isFar ? std::numeric_limits<float>::infinity() : 1.0f};
    }
    const EmbreeScene tracer(state_, ExpectedRays::Few);
    std::vector<uint32_t> occluded(kTimedRays);
    const auto start = std::chrono::steady_clock::now();
    tracer.occluded(rays, occluded);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    raysPerSecond_ = kTimedRays / std::max(taken.count(), 1e-6);
    return *raysPerSecond_;
}

std::vector<std::string> LightCost::warnings(std::span<const Graph::PassInfo> passes) {
    std::vector<std::string> texts;
    if (state_.lights.size() < kLights || state_.geometry.triangles.empty()) return texts;
    for (const Graph::PassInfo& pass : passes) {
        if (pass.lightRays < kMaxUnasked) continue;
        const double seconds = double(pass.lightRays) / raysPerSecond();
        if (seconds < kLongSeconds) continue;
        texts.push_back(
            UsageError(
                pass.where,
                "{}: {} lights take {:.0f} million rays, about {} on this machine's CPU each time that it "
                "runs: it takes as long for each light; lower the size of the image or its own "
                "parameters, or leave lights out with 'keep_file_lights: false'",
                pass.id, state_.lights.size(), double(pass.lightRays) / 1e6, duration(seconds))
                .what());
    }
    return texts;
}

}  // namespace voxray
