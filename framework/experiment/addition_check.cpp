#include "experiment/addition_check.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

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

/// What to say of one addition, "" where it fits.
std::string warningOf(const SceneAddition& addition, const Box& added, const Box& scene) {
    const float own = sizeOf(added), whole = sizeOf(scene);
    if (own == 0 || whole == 0) return {};
    const glm::vec3 gap = glm::max(glm::max(added.min - scene.max, scene.min - added.max), glm::vec3(0.0f));
    const float distance = glm::length(gap);
    const TextLocation& where = addition.source.where;
    const std::string sizes = fmt::format("'{}' is {:.3g} m across, the scene that it is added to {:.3g} m",
                                          addition.source.name(), own, whole);
    const auto unit = [&](float factor) {
        return fmt::format("is one of the two in centimetres? then write transform: {{scale: {}}}",
                           scaled(addition.placement, factor));
    };
    if (own >= kCentimetres * whole)
        return UsageError(where, "{}: {}; {}", addition.source.owner, sizes, unit(1 / kCentimetres)).what();
    if (kCentimetres * own <= whole)
        return UsageError(where, "{}: {}; {}", addition.source.owner, sizes, unit(kCentimetres)).what();
    if (distance >= kCentimetres * whole)
        return UsageError(where, "{}: {}, and {:.3g} m away; is its 'translate' in metres?",
                          addition.source.owner, sizes, distance)
            .what();
    return {};
}

}  // namespace

std::vector<std::string> additionWarnings(const SceneSettings& scene, const PreparedScene& prepared,
                                          SceneLoader& loader) {
    // Meshes of what is added follow the scene's own, and keep their numbers where instances are hidden
    std::vector<std::string> warnings;
    size_t first = loader.load(scene.source)->meshes.size();
    const Box whole = boundsOf(prepared.state, 0, first);
    for (const SceneAddition& addition : scene.additions) {
        const size_t count = loader.load(addition.source)->meshes.size();
        if (std::string text = warningOf(addition, boundsOf(prepared.state, first, count), whole);
            !text.empty())
            warnings.push_back(std::move(text));
        first += count;
    }
    return warnings;
}

}  // namespace voxray
