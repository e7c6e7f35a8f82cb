#include "experiment/checks/cost.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <limits>

#include "base/byte_units.h"
#include "config/overrides.h"
#include "experiment/checks/checks.h"
#include "scene/load.h"
#include "trace/embree_scene.h"
#include "trace/gpu_scene.h"

namespace voxray {
namespace {

constexpr size_t kMinLights = 16;          ///< With fewer lights nothing is checked.
constexpr uint64_t kMinRays = 20'000'000;  ///< With fewer rays nothing is checked.
constexpr double kLongSeconds = 10;
constexpr uint32_t kTimedRays = 1u << 16;

std::string duration(double seconds) {
    return seconds < 100 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60);
}

/// The memory of a variant.
struct MemoryNeed {
    std::string variant;
    uint64_t bytes;
    std::string largest;  ///< Id of the pass with most memory.
};

MemoryNeed memoryNeedOf(const Variant& variant) {
    const std::vector<Graph::PassInfo> passes = variant.graph.passes();
    const auto bytes = [](const PassMemory& memory) { return memory.bytes + memory.scratchBytes; };
    const auto largest = std::ranges::max_element(variant.memory, {}, bytes);
    return {variant.name, peakBytes(variant.memory), passes[size_t(largest - variant.memory.begin())].id};
}

/// Ways to reduce the number of triangles.
std::vector<std::string> fewerTriangles(const SceneSettings& settings) {
    std::vector<std::string> remedies;
    if (settings.options.subdivide > 0) remedies.emplace_back("lower scene.subdivide");
    if (!settings.additions.empty()) remedies.emplace_back("place fewer copies in scene.add");
    if (settings.movingSpheres && settings.movingSpheres->count > 0)
        remedies.emplace_back("lower scene.moving_spheres.count");
    if (settings.source.builtin.empty())
        remedies.emplace_back("simplify its meshes");
    else
        for (const ParameterDoc& doc : describeBuiltinScene(settings.source.builtin))
            if (doc.type == "integer") remedies.push_back("lower scene." + doc.name);
    return remedies;
}

/// Ways to reduce the size of textures.
std::vector<std::string> smallerTextures(const SceneSettings& settings, const Scene& scene) {
    const auto texels = [](const Texture& texture) { return uint64_t(texture.width) * texture.height; };
    const Texture& largest = *std::ranges::max_element(scene.textures, {}, texels);
    std::vector<std::string> remedies;
    if (!settings.additions.empty()) remedies.emplace_back("place fewer copies in scene.add");
    remedies.push_back(fmt::format("make its textures smaller; the largest is '{}' of {} x {}", largest.name,
                                   largest.width, largest.height));
    return remedies;
}

}  // namespace

double ShadowRayCost::perSecond() {
    if (perSecond_) return *perSecond_;
    // Rays from vertices all over the scene to all lights in turn
    const Geometry& g = state_.geometry;
    std::vector<Ray> rays(kTimedRays);
    for (uint32_t i = 0; i < kTimedRays; ++i) {
        const glm::vec3 from = g.positions[g.triangles[uint64_t(i) * g.triangles.size() / kTimedRays].x];
        const Light& light = state_.lights[i % state_.lights.size()];
        const bool isFar = light.type == LightType::Directional;
        const glm::vec3 toLight = isFar ? -light.direction : light.position - from;
        rays[i] = {from, 1e-3f, toLight, isFar ? std::numeric_limits<float>::infinity() : 1.0f};
    }
    const EmbreeScene tracer(state_, ExpectedRays::Few);
    std::vector<uint32_t> occluded(kTimedRays);
    const auto start = std::chrono::steady_clock::now();
    tracer.occluded(rays, occluded);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    perSecond_ = kTimedRays / std::max(taken.count(), 1e-6);
    return *perSecond_;
}

void ShadowRayCost::check(std::span<const Graph::PassInfo> passes, Diagnostics& found) {
    if (state_.lights.size() < kMinLights || state_.geometry.triangles.empty()) return;
    for (const Graph::PassInfo& pass : passes) {
        if (pass.lightRays < kMinRays) continue;
        const double seconds = double(pass.lightRays) / perSecond();
        if (seconds < kLongSeconds) continue;
        found.push_back(
            {pass.where,
             fmt::format(
                 "{}: {} lights take {:.0f} million rays, about {} on this machine's CPU each time that it runs: "
                 "it takes as long for each light",
                 pass.id, state_.lights.size(), double(pass.lightRays) / 1e6, duration(seconds)),
             "lower the size of the image or its own parameters, or leave lights out with 'keep_file_lights: false'"});
    }
}

void slowShadowRays(const PlannedVariant& v, Diagnostics& found) {
    v.shadowRayCost.check(v.variant.graph.passes(), found);
}

/// Warns of variants that exceed the config's limit of memory. @throws UsageError if all do.
void exceededMemoryLimit(const Study& study, Diagnostics& found) {
    const uint64_t limitMb = study.experiment.measure.memoryLimitMb;
    std::vector<MemoryNeed> needs;
    for (const Variant& variant : study.variants) {
        if (variant.memory.empty()) return;  // Only one variant was planned.
        needs.push_back(memoryNeedOf(variant));
    }
    const auto isOver = [&](const MemoryNeed& need) { return limitMb > 0 && need.bytes > limitMb << 20; };
    const size_t over = size_t(std::ranges::count_if(needs, isOver));
    if (over == 0) return;
    std::ranges::stable_sort(needs, {}, &MemoryNeed::bytes);
    const auto& [variant, bytes, largest] = *std::ranges::find_if(needs, isOver);
    const Diagnostic finding{locationOf(study.experiment.config, "measure.memory_limit_mb"),
                             fmt::format("measure.memory_limit_mb: {} MiB are too few for {} of {} variants: "
                                         "{} takes at least {:.1f} MiB, the largest part of it by '{}'",
                                         limitMb, over, needs.size(), variant, double(bytes) / kMiB, largest),
                             ""};
    if (over == needs.size()) throw UsageError("{}", finding.str());
    found.push_back(finding);
}

std::string sceneSizeAdvice(const SceneSettings& settings, const SceneState& state) {
    const Scene& scene = *state.scene;
    const uint64_t textures = gpuTextureBytes(scene), triangles = gpuSceneBytes(state) - textures;
    const uint64_t map = gpuEnvironmentBytes(scene.environment);
    std::vector<std::string> remedies;
    if (map > std::max(textures, triangles))
        remedies = {"take a smaller map for scene.environment"};
    else if (textures > triangles)
        remedies = smallerTextures(settings, scene);
    else
        remedies = fewerTriangles(settings);
    remedies.emplace_back("take another --device");
    return fmt::format("its {} triangles take {:.1f} MiB, its {} textures {:.1f} MiB, its environment {:.1f} MiB: {}",
                       state.geometry.triangles.size(), double(triangles) / kMiB, scene.textures.size(),
                       double(textures) / kMiB, double(map) / kMiB, fmt::join(remedies, ", or "));
}

}  // namespace voxray
