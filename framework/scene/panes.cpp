#include "scene/panes.h"

#include <algorithm>

#include "scene/select_instances.h"

namespace voxray {
namespace {

/// Transmission from which a surface is a pane.
constexpr float kMinTransmission = 0.5f;

/// Whether the transmittance of a pane is 1.
bool isClear(const Material& material, const Mesh& mesh) {
    const auto isWhite = [](const glm::vec4& color) { return glm::vec3(color) == glm::vec3(1.0f); };
    return material.transmission == 1 && material.metallic == 0 && isWhite(material.baseColor) &&
           material.baseColorTexture.texture < 0 && std::ranges::all_of(mesh.colors, isWhite);
}

/// Replaces textures that don't affect the panes' transmittance by one texel; indices don't change.
void dropUnusedTextures(Scene& panes) {
    std::vector<bool> isRead(panes.textures.size());
    for (const Instance& instance : panes.instances) {
        const Material& material = panes.materials[panes.meshes[instance.mesh].material];
        for (const TextureRef* ref : {&material.baseColorTexture, &material.metallicRoughnessTexture})
            if (ref->texture >= 0) isRead[size_t(ref->texture)] = true;
    }
    for (size_t i = 0; i < panes.textures.size(); ++i)
        if (!isRead[i])
            panes.textures[i] = {.name = panes.textures[i].name, .width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
}

}  // namespace

bool isPane(const Material& material) {
    return material.transmission >= kMinTransmission && material.emission == glm::vec3(0.0f);
}

SplitScene splitPanes(std::shared_ptr<const Scene> scene) {
    const auto isPaneInstance = [&](const Instance& instance) {
        return isPane(scene->materials[scene->meshes[instance.mesh].material]);
    };
    const auto panes = std::ranges::count_if(scene->instances, isPaneInstance);
    if (panes == 0 || size_t(panes) == scene->instances.size()) return {std::move(scene), nullptr};

    SplitScene split;
    auto surfaces = std::make_shared<Scene>(*scene);
    filterInstances(*surfaces, [&](const Instance& instance) { return !isPaneInstance(instance); });
    split.surfaces = std::move(surfaces);
    auto onlyPanes = std::make_shared<Scene>(*scene);
    filterInstances(*onlyPanes, isPaneInstance);
    dropUnusedTextures(*onlyPanes);
    onlyPanes->lights.clear();
    onlyPanes->environment = {};
    split.panes = std::move(onlyPanes);
    return split;
}

SceneState evaluateWithPanes(std::shared_ptr<const Scene> scene, double timeSeconds, Playback playback) {
    const SplitScene split = splitPanes(std::move(scene));
    SceneState state = evaluate(split.surfaces, timeSeconds, playback);
    if (split.panes) state.panes = std::make_shared<SceneState>(evaluate(split.panes, timeSeconds, playback));
    return state;
}

bool dimsLight(const SceneState& state) {
    if (!state.panes) return false;
    const Scene& panes = *state.panes->scene;
    return std::ranges::any_of(panes.instances, [&](const Instance& instance) {
        const Mesh& mesh = panes.meshes[instance.mesh];
        return !isClear(panes.materials[mesh.material], mesh);
    });
}

}  // namespace voxray
