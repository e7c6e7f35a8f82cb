#include "scene/builtin.h"

#include "base/suggest.h"
#include "scene/content_hash.h"
#include "scene/load.h"

namespace voxray {
namespace {

std::vector<BuiltinScene> allScenes() {
    std::vector<BuiltinScene> scenes = roomScenes();
    for (const auto& more :
         {daylightScenes(), clutterScenes(), closedFormScenes(), lampScenes(), livingScenes(), movingScenes()})
        scenes.insert(scenes.end(), more.begin(), more.end());
    return scenes;
}

BuiltinScene find(const std::string& name, const TextLocation& where) {
    for (const BuiltinScene& scene : allScenes())
        if (name == scene.name) return scene;
    throw UsageError(where, "unknown built-in scene '{}'{}", name, didYouMean(name, builtinSceneNames()));
}

}  // namespace

std::vector<std::string> builtinSceneNames() {
    std::vector<std::string> names;
    for (const BuiltinScene& scene : allScenes()) names.emplace_back(scene.name);
    return names;
}

std::shared_ptr<const Scene> makeBuiltinScene(const std::string& name, const Value& params) {
    return find(name, params.where).make(params);
}

std::vector<ParameterDoc> describeBuiltinScene(const std::string& name) {
    return find(name, {}).describe();
}

std::shared_ptr<const Scene> withLambertMaterials(const Scene& scene) {
    auto lambert = std::make_shared<Scene>(scene);
    for (Material& material : lambert->materials) {
        material.metallic = 0;
        material.specular = 0;
        material.transmission = 0;
        material.metallicRoughnessTexture = {};
    }
    lambert->contentHash = hashScene(*lambert);
    return lambert;
}

}  // namespace voxray
