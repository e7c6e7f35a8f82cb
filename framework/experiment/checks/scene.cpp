#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>

#include "base/parallel.h"
#include "config/overrides.h"
#include "experiment/checks/checks.h"

namespace voxray {
namespace {

constexpr float kCentimetres = 100;  ///< In a metre.
constexpr float kFlat = 1e-3f;       ///< Largest ratio of thickness to size of a flat scene.
constexpr size_t kGrain = 1 << 14;   ///< Vertices that are worth a thread.

/// Bounds, in the compared frame, of the instances of `count` meshes; without any min > max.
Box boundsOf(const SceneState& state, size_t firstMesh, size_t count) {
    const Geometry& g = state.geometry;
    Box box{glm::vec3(std::numeric_limits<float>::infinity()), {}};
    box.max = -box.min;
    const Box empty = box;
    std::mutex mutex;
    for (size_t i = 0; i < g.instances.size(); ++i) {
        if (state.scene->instances[i].mesh - firstMesh >= count) continue;
        const InstanceRange& range = g.instances[i];
        parallelRanges(range.vertexCount, kGrain, [&](size_t begin, size_t end) {
            Box part = empty;
            for (size_t v = range.firstVertex + begin; v < range.firstVertex + end; ++v)
                part = {glm::min(part.min, g.positions[v]), glm::max(part.max, g.positions[v])};
            const std::lock_guard lock(mutex);
            box = {glm::min(box.min, part.min), glm::max(box.max, part.max)};
        });
    }
    return box;
}

/// Length of the diagonal, m; 0 if the box is flat or empty.
float sizeOf(const Box& box) {
    const glm::vec3 sides = box.max - box.min;
    const float size = glm::length(sides);
    return glm::min(sides.x, glm::min(sides.y, sides.z)) > kFlat * size ? size : 0.0f;
}

/// A placement's scale times a factor, as "7" or "[7, 7, 14]".
std::string scaled(const Placement& placement, float factor) {
    const glm::vec3 scale = factor * placement.scale;
    return scale == glm::vec3(scale.x) ? fmt::format("{:.4g}", scale.x)
                                       : fmt::format("[{:.4g}, {:.4g}, {:.4g}]", scale.x, scale.y, scale.z);
}

/// A diagnostic of an addition, without text if its size fits.
Diagnostic findingOf(const SceneAddition& addition, const Box& added, const Box& scene) {
    const float size = sizeOf(added), whole = sizeOf(scene);
    if (size == 0 || whole == 0) return {};
    const glm::vec3 gap = glm::max(glm::max(added.min - scene.max, scene.min - added.max), glm::vec3(0.0f));
    const float distance = glm::length(gap);
    const TextLocation& where = addition.source.where;
    const std::string sizes = fmt::format("{}: '{}' is {:.3g} m across, the scene that it is added to {:.3g} m",
                                          addition.source.owner, addition.source.name(), size, whole);
    const auto unit = [&](float factor) {
        return fmt::format("is one of the two in centimetres? then write transform: {{scale: {}}}",
                           scaled(addition.placement, factor));
    };
    if (size >= kCentimetres * whole) return {where, sizes, unit(1 / kCentimetres)};
    if (kCentimetres * size <= whole) return {where, sizes, unit(kCentimetres)};
    if (distance >= kCentimetres * whole)
        return {where, fmt::format("{}, and {:.3g} m away", sizes, distance), "is its 'translate' in metres?"};
    return {};
}

}  // namespace

Diagnostics checkAddedSceneUnits(const SceneSettings& scene, const PreparedScene& prepared, SceneLoader& loader) {
    // Meshes of additions follow those of the scene. Their indices don't change if instances are hidden
    Diagnostics all;
    if (scene.additions.empty()) return all;
    size_t first = loader.load(scene.source)->meshes.size();
    const Box whole = boundsOf(prepared.state, 0, first);
    for (const SceneAddition& addition : scene.additions) {
        const size_t count = loader.load(addition.source)->meshes.size();
        Diagnostic finding = findingOf(addition, boundsOf(prepared.state, first, count), whole);
        if (!finding.text.empty()) all.push_back(std::move(finding));
        first += count;
    }
    return all;
}

void checkAddedSceneUnits(const PlannedVariant& v, Diagnostics& found) {
    if (!v.isNewScene) return;
    for (Diagnostic& diagnostic : checkAddedSceneUnits(v.variant.setup.scene, v.scene, v.loader))
        found.push_back(std::move(diagnostic));
}

/// Warns if the config removes punctual lights of a scene that has none: probably others are intended.
void keepFileLightsWithoutLights(const PlannedVariant& v, Diagnostics& found) {
    if (v.variant.setup.scene.options.keepFileLights || !v.scene.state.scene->lights.empty()) return;
    found.push_back({locationOf(v.variant.config, "scene.keep_file_lights"),
                     "scene.keep_file_lights: the scene has no punctual lights",
                     "what else shines stays: 'override: {MATERIAL: {emission: 0}}' puts out a surface, 'environment: "
                     "none' the sky"});
}

/// Warns of what swings without a time step.
void staticSwings(const PlannedVariant& v, Diagnostics& found) {
    const SceneSettings& scene = v.variant.setup.scene;
    if (scene.options.timeStep > 0) return;
    const auto warn = [&](const char* key, const char* what) {
        found.push_back({locationOf(v.variant.config, key), what,
                         "for motion write 'time_step', the seconds from one frame to the next, in 'scene'"});
    };
    if (scene.movingSpheres && scene.movingSpheres->count > 0)
        warn("scene.moving_spheres", "scene.moving_spheres: they stand still");
    if (std::ranges::any_of(scene.additions, [](const SceneAddition& added) { return added.swing.has_value(); }))
        warn("scene.add", "scene.add: what has a 'swing' stands still");
}

}  // namespace voxray
