#include "experiment/checks/blockers.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <optional>
#include <vector>

#include "scene/select_instances.h"

namespace voxray {
namespace {

/// Surfaces that are looked through on the way to a light, at most.
constexpr int kSurfaces = 64;

/// The instance that all surfaces on a way belong to, if they do.
std::optional<uint32_t> onlyBlocker(Ray way, const SceneState& state, const EmbreeScene& tracer) {
    std::optional<uint32_t> only;
    for (int i = 0; i < kSurfaces; ++i) {
        const Hit hit = tracer.closestHit(way);
        if (hit.triangle == Hit::kMiss) return only;
        const uint32_t instance = instanceOf(state.geometry, hit.triangle);
        if (only.value_or(instance) != instance) return {};
        only = instance;
        way.tMin = hit.t * (1 + 1e-5f);
    }
    return {};
}

bool isGlass(const Material& material) {
    return material.alphaMode == AlphaMode::Blend || material.transmission > 0;
}

/// Whether all of the scene lies within an instance's box, but for a hundredth.
bool encloses(const Geometry& g, const InstanceRange& range) {
    glm::vec3 low = g.positions[range.firstVertex], high = low;
    for (uint32_t i = range.firstVertex; i < range.firstVertex + range.vertexCount; ++i) {
        low = glm::min(low, g.positions[i]);
        high = glm::max(high, g.positions[i]);
    }
    const glm::vec3 spare = 0.01f * (g.boundsMax - g.boundsMin);
    return glm::all(glm::lessThanEqual(low, g.boundsMin + spare)) &&
           glm::all(glm::greaterThanEqual(high, g.boundsMax - spare));
}

/// A name to take the object out by: of its node, its mesh or its material.
std::string nameOf(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const std::string node = instance.node < 0 ? "" : scene.nodes[size_t(instance.node)].name;
    return !node.empty() ? node : !mesh.name.empty() ? mesh.name : scene.materials[mesh.material].name;
}

}  // namespace

std::string blockerAdvice(std::span<const Ray> ways, const SceneState& state, const EmbreeScene& tracer) {
    const Scene& scene = *state.scene;
    std::vector<size_t> blocked(scene.instances.size());
    for (const Ray& way : ways)
        if (way.tMax > way.tMin)
            if (const auto instance = onlyBlocker(way, state, tracer)) ++blocked[*instance];

    // Glass counts for more than a dome, a dome for more than a wall.
    const auto rank = [&](uint32_t i) {
        const bool glass = isGlass(scene.materials[scene.meshes[scene.instances[i].mesh].material]);
        return std::pair(glass                                                   ? 2
                         : encloses(state.geometry, state.geometry.instances[i]) ? 1
                                                                                 : 0,
                         blocked[i]);
    };
    std::optional<uint32_t> worst;
    for (uint32_t i = 0; i < blocked.size(); ++i)
        if (blocked[i] > 0 && (!worst || rank(i) > rank(*worst))) worst = i;
    if (!worst) return "";
    const Instance& instance = scene.instances[*worst];
    const std::string name = nameOf(scene, instance);
    const auto goesByIt = [&](const Instance& other) {
        return std::ranges::count(namesOfInstance(scene, other), name) > 0;
    };
    if (name.empty() || std::ranges::all_of(scene.instances, goesByIt)) return "";
    const Material& material = scene.materials[scene.meshes[instance.mesh].material];
    return fmt::format(
        "'{}' is in its way{}: 'scene.hide: [\"{}\"]' takes it out of the scene", name,
        isGlass(material) ? fmt::format(", of the glass '{}', which is opaque here", material.name) : "",
        name);
}

}  // namespace voxray
