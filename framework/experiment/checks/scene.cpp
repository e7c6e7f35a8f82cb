#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "config/overrides.h"
#include "experiment/checks/checks.h"

namespace voxray {
namespace {

constexpr float kCentimetres = 100;  ///< In a metre.
constexpr float kFlat = 1e-3f;       ///< Thickness over size of what counts as flat.

/// Bounds in the compared frame of the instances of `count` meshes; empty, with min over max, where there are
/// none.
Box boundsOf(const SceneState& state, size_t firstMesh, size_t count) {
    const Geometry& g = state.geometry;
    Box box{glm::vec3(std::numeric_limits<float>::infinity()), {}};
    box.max = -box.min;
    for (size_t i = 0; i < g.instances.size(); ++i) {
        if (state.scene->instances[i].mesh - firstMesh >= count) continue;
        const InstanceRange& range = g.instances[i];
        for (uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v)
            box = {glm::min(box.min, g.positions[v]), glm::max(box.max, g.positions[v])};
    }
    return box;
}

/// Its diagonal, m; 0 where it is flat or empty.
float sizeOf(const Box& box) {
    const glm::vec3 sides = box.max - box.min;
    const float size = glm::length(sides);
    return glm::min(sides.x, glm::min(sides.y, sides.z)) > kFlat * size ? size : 0.0f;
}

/// "7" or "[7, 7, 14]": a placement's scale times a factor.
std::string scaled(const Placement& placement, float factor) {
    const glm::vec3 scale = factor * placement.scale;
    return scale == glm::vec3(scale.x) ? fmt::format("{:.4g}", scale.x)
                                       : fmt::format("[{:.4g}, {:.4g}, {:.4g}]", scale.x, scale.y, scale.z);
}

/// What to say of one addition; no text where it fits.
Diagnostic findingOf(const SceneAddition& addition, const Box& added, const Box& scene) {
    const float own = sizeOf(added), whole = sizeOf(scene);
    if (own == 0 || whole == 0) return {};
    const glm::vec3 gap = glm::max(glm::max(added.min - scene.max, scene.min - added.max), glm::vec3(0.0f));
    const float distance = glm::length(gap);
    const TextLocation& where = addition.source.where;
    const std::string sizes =
        fmt::format("{}: '{}' is {:.3g} m across, the scene that it is added to {:.3g} m",
                    addition.source.owner, addition.source.name(), own, whole);
    const auto unit = [&](float factor) {
        return fmt::format("is one of the two in centimetres? then write transform: {{scale: {}}}",
                           scaled(addition.placement, factor));
    };
    if (own >= kCentimetres * whole) return {where, sizes, unit(1 / kCentimetres)};
    if (kCentimetres * own <= whole) return {where, sizes, unit(kCentimetres)};
    if (distance >= kCentimetres * whole)
        return {where, fmt::format("{}, and {:.3g} m away", sizes, distance),
                "is its 'translate' in metres?"};
    return {};
}

}  // namespace

Diagnostics checkAddedSceneUnits(const SceneSettings& scene, const PreparedScene& prepared,
                                 SceneLoader& loader) {
    // Meshes of what is added follow the scene's own, and keep their numbers where instances are hidden
    Diagnostics all;
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
    for (Diagnostic& own : checkAddedSceneUnits(v.variant.setup.scene, v.scene, v.loader))
        found.push_back(std::move(own));
}

/// The config takes away lights that the scene does not have: mostly others are meant.
void lightsThatAreNotThere(const PlannedVariant& v, Diagnostics& found) {
    if (v.variant.setup.scene.options.keepFileLights || !v.scene.state.scene->lights.empty()) return;
    found.push_back(
        {locationOf(v.variant.config, "scene.keep_file_lights"),
         "scene.keep_file_lights: the scene has no punctual lights",
         "what else shines stays: 'override: {MATERIAL: {emission: 0}}' puts out a surface, 'environment: "
         "none' the sky"});
}

/// Spheres that are to move and have no time to.
void spheresThatStandStill(const PlannedVariant& v, Diagnostics& found) {
    const SceneSettings& scene = v.variant.setup.scene;
    if (!scene.movingSpheres || scene.movingSpheres->count == 0 || scene.options.timeStep > 0) return;
    found.push_back(
        {locationOf(v.variant.config, "scene.moving_spheres"), "scene.moving_spheres: they stand still",
         "for ones that move write 'time_step', the seconds from one frame to the next, next to it"});
}

}  // namespace voxray
