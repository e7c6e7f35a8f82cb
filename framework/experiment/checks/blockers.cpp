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

/// Limit of surfaces between a point and a light.
constexpr int kMaxSurfaces = 64;

/// The instance to which all surfaces on a ray belong; nullopt if there are several instances or none.
std::optional<uint32_t> soleOccluder(Ray ray, const SceneState& state, const EmbreeScene& tracer) {
    std::optional<uint32_t> only;
    for (int i = 0; i < kMaxSurfaces; ++i) {
        const Hit hit = tracer.closestHit(ray);
        if (hit.triangle == Hit::kMiss) return only;
        const uint32_t instance = instanceOf(state.geometry, hit.triangle);
        if (only.value_or(instance) != instance) return {};
        only = instance;
        ray.tMin = hit.t * (1 + 1e-5f);
    }
    return {};
}

bool isGlass(const Material& material) {
    return material.alphaMode == AlphaMode::Blend || material.transmission > 0;
}

/// Whether an instance's bounding box contains the scene, up to a hundredth of its size.
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

/// A name of the object for `scene.hide`: that of its node, its mesh or its material.
std::string nameOf(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const std::string node = instance.node < 0 ? "" : scene.nodes[size_t(instance.node)].name;
    return !node.empty() ? node : !mesh.name.empty() ? mesh.name : scene.materials[mesh.material].name;
}

}  // namespace

std::string occluderAdvice(std::span<const Ray> rays, const SceneState& state, const EmbreeScene& tracer) {
    const Scene& scene = *state.scene;
    std::vector<size_t> blocked(scene.instances.size());
    for (const Ray& ray : rays)
        if (ray.tMax > ray.tMin)
            if (const auto instance = soleOccluder(ray, state, tracer)) ++blocked[*instance];

    // Glass has the highest rank, then enclosing objects
    const auto rank = [&](uint32_t i) {
        const bool glass = isGlass(scene.materials[scene.meshes[scene.instances[i].mesh].material]);
        return std::pair(glass ? 2 : encloses(state.geometry, state.geometry.instances[i]) ? 1 : 0, blocked[i]);
    };
    std::optional<uint32_t> worst;
    for (uint32_t i = 0; i < blocked.size(); ++i)
        if (blocked[i] > 0 && (!worst || rank(i) > rank(*worst))) worst = i;
    if (!worst) return "";
    const Instance& instance = scene.instances[*worst];
    const std::string name = nameOf(scene, instance);
    const auto hasName = [&](const Instance& other) {
        return std::ranges::count(namesOfInstance(scene, other), name) > 0;
    };
    if (name.empty() || std::ranges::all_of(scene.instances, hasName)) return "";
    const Material& material = scene.materials[scene.meshes[instance.mesh].material];
    return fmt::format("'{}' is in its way{}: 'scene.hide: [\"{}\"]' takes it out of the scene", name,
                       isGlass(material) ? fmt::format(", of the glass '{}', which is opaque here", material.name) : "",
                       name);
}

}  // namespace voxray
