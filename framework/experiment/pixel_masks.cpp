#include "experiment/pixel_masks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <unordered_set>

#include "base/parallel.h"
#include "base/suggest.h"
#include "scene/camera_rays.h"
#include "trace/texture_lookup.h"

namespace voxray {
namespace {

constexpr uint32_t kSubPixels = 2;  ///< Along each edge of a pixel.

/// The condition of a mask, with flags for the instances and materials that it names.
struct MaskCondition {
    std::vector<bool> instances, materials;
    float minMetallic, maxRoughness;
};

/// Names of the mesh and of the node of an instance.
std::array<std::string, 2> namesOf(const Instance& instance, const Scene& scene) {
    return {scene.meshes[instance.mesh].name, instance.node >= 0 ? scene.nodes[size_t(instance.node)].name : ""};
}

MaskCondition conditionOf(const MaskSettings& mask, const Scene& scene) {
    MaskCondition condition{{}, {}, mask.minMetallic, mask.maxRoughness};
    std::vector<std::string> materials;
    for (const Material& material : scene.materials) {
        condition.materials.push_back(mask.material.empty() || material.name == mask.material);
        materials.push_back(material.name);
    }
    for (const Instance& instance : scene.instances)
        condition.instances.push_back(mask.object.empty() ||
                                      std::ranges::count(namesOf(instance, scene), mask.object) > 0);
    const auto lacks = [](const std::vector<bool>& chosen) { return std::ranges::count(chosen, true) == 0; };
    if (lacks(condition.materials))
        throw UsageError(mask.where, "measure.masks.{}: the scene has no material '{}'{}", mask.name, mask.material,
                         didYouMean(mask.material, materials));
    if (lacks(condition.instances))
        throw UsageError(mask.where, "measure.masks.{}: the scene has no object '{}'{}", mask.name, mask.object,
                         didYouMean(mask.object, objectNames(scene)));
    return condition;
}

bool isMet(const MaskCondition& condition, const SceneState& state, const Hit& hit) {
    if (hit.triangle == Hit::kMiss) return false;
    const Geometry& geometry = state.geometry;
    const uint32_t number = geometry.triangleMaterials[hit.triangle];
    if (!condition.materials[number] || !condition.instances[instanceOf(geometry, hit.triangle)]) return false;

    // Metallic and roughness at the hit
    const Material& material = state.scene->materials[number];
    float metallic = material.metallic, roughness = material.roughness;
    if (const int32_t texture = material.metallicRoughnessTexture.texture; texture >= 0) {
        const glm::uvec3 corners = geometry.triangles[hit.triangle];
        const glm::vec4 texCoords =
            interpolate(geometry.attributes[corners.x].texCoords, geometry.attributes[corners.y].texCoords,
                        geometry.attributes[corners.z].texCoords, hit.u, hit.v);
        const glm::vec4 texel = sampleTexture(state.scene->textures[size_t(texture)],
                                              textureCoordinates(material.metallicRoughnessTexture, texCoords));
        roughness *= texel.g;
        metallic *= texel.b;
    }
    return metallic >= condition.minMetallic && roughness <= condition.maxRoughness;
}

/// Whether any triangle may meet the condition. A texture can reduce metallic and roughness down to 0.
bool isMetSomewhere(const MaskCondition& condition, const SceneState& state) {
    const Geometry& geometry = state.geometry;
    for (uint32_t t = 0; t < geometry.triangles.size(); ++t) {
        const uint32_t number = geometry.triangleMaterials[t];
        const Material& material = state.scene->materials[number];
        const bool hasTexture = material.metallicRoughnessTexture.texture >= 0;
        if (condition.materials[number] && condition.instances[instanceOf(geometry, t)] &&
            material.metallic >= condition.minMetallic &&
            (hasTexture ? 0.0f : material.roughness) <= condition.maxRoughness)
            return true;
    }
    return false;
}

/// Calls body(x, y, hit) for each pixel of an image, with the hit at its center. Rows run in parallel.
template <typename Body>
void forEachPixel(const SceneState& state, const Camera& camera, uint32_t width, uint32_t height, const Body& body) {
    const EmbreeScene scene(state);
    const CameraRays rays = cameraRays(camera, width, height);
    parallelRanges(height, 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (uint32_t x = 0; x < width; ++x) {
                const glm::vec3 direction =
                    rays.direction((float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height));
                body(x, uint32_t(y),
                     scene.closestHit({rays.origin, 0.0f, direction, std::numeric_limits<float>::infinity()}));
            }
    });
}

}  // namespace

std::vector<std::string> objectNames(const Scene& scene) {
    std::vector<std::string> names;
    std::unordered_set<std::string> known;
    for (const Instance& instance : scene.instances)
        for (const std::string& name : namesOf(instance, scene))
            if (!name.empty() && known.insert(name).second) names.push_back(name);
    return names;
}

void checkMaskNames(const std::vector<MaskSettings>& masks, const Scene& scene) {
    for (const MaskSettings& mask : masks) conditionOf(mask, scene);
}

std::vector<PixelSelection> selectPixels(const std::vector<MaskSettings>& masks, const SceneState& state,
                                         const Camera& camera, uint32_t width, uint32_t height) {
    if (masks.empty()) return {};
    std::vector<MaskCondition> conditions;
    std::vector<PixelSelection> selections;
    for (const MaskSettings& mask : masks) {
        conditions.push_back(conditionOf(mask, *state.scene));
        selections.push_back({mask.name, std::vector<uint8_t>(size_t(width) * height, 1), 0});
    }

    // The two rows of sub-pixels of a row of pixels may be processed by different threads, which only write 0
    forEachPixel(state, camera, width * kSubPixels, height * kSubPixels, [&](uint32_t x, uint32_t y, const Hit& hit) {
        const size_t pixel = size_t(y / kSubPixels) * width + x / kSubPixels;
        for (size_t m = 0; m < masks.size(); ++m)
            if (!isMet(conditions[m], state, hit))
                std::atomic_ref(selections[m].pixels[pixel]).store(0, std::memory_order_relaxed);
    });
    for (PixelSelection& selection : selections)
        selection.count = size_t(std::ranges::count(selection.pixels, uint8_t(1)));
    return selections;
}

Diagnostics maskWarnings(const std::vector<MaskSettings>& masks, const std::vector<PixelSelection>& selections,
                         const SceneState& state) {
    Diagnostics found;
    for (size_t m = 0; m < masks.size(); ++m) {
        const std::string name = "measure.masks." + masks[m].name;
        if (selections[m].count == 0)
            found.push_back({masks[m].where, name + ": it selects no pixel and has no scores:",
                             isMetSomewhere(conditionOf(masks[m], *state.scene), state)
                                 ? "what meets its conditions is out of sight, or fills no whole pixel"
                                 : "no surface of the scene meets all of its conditions"});
        if (selections[m].count == selections[m].pixels.size())
            found.push_back({masks[m].where,
                             name + ": it selects every pixel, so that its scores are those of the whole image:",
                             "write a condition that some of what is in view does not meet, or leave it out"});
    }
    return found;
}

std::string maskKey(const std::string& sceneKey, const ImageSettings& image) {
    return fmt::format("{} {} {}", sceneKey, image.width, image.height);
}

std::vector<PrimaryHit> primaryHits(const SceneState& state, const Camera& camera, uint32_t width, uint32_t height) {
    std::vector<PrimaryHit> hits(size_t(width) * height);
    forEachPixel(state, camera, width, height, [&](uint32_t x, uint32_t y, const Hit& hit) {
        PrimaryHit& primary = hits[size_t(y) * width + x];
        primary.depth = hit.t;  // Directions have length 1 along the axis
        if (hit.triangle == Hit::kMiss) return;
        primary.instance = int32_t(instanceOf(state.geometry, hit.triangle));
        primary.material = int32_t(state.geometry.triangleMaterials[hit.triangle]);
    });
    return hits;
}

}  // namespace voxray
