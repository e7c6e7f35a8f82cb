#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "config/yaml.h"
#include "scene/load.h"
#include "scene/moving_spheres.h"
#include "scene/shapes.h"

namespace voxray::test {

using State = std::shared_ptr<const SceneState>;

/// A scene at one time. States that shall go on to other times are evaluated as `Looping`.
inline std::shared_ptr<SceneState> evaluated(std::shared_ptr<const Scene> scene, double seconds = 0,
                                             Playback playback = Playback::Frozen) {
    return std::make_shared<SceneState>(evaluate(std::move(scene), seconds, playback));
}
inline std::shared_ptr<SceneState> evaluated(SceneBuilder& builder) {
    return evaluated(builder.finish());
}

/// A copy of a built-in scene, to change it.
inline std::shared_ptr<Scene> builtinScene(const std::string& name, const std::string& parameters = "{}") {
    return std::make_shared<Scene>(*makeBuiltinScene(name, parseYaml(parameters, "scene")));
}

/// A built-in scene at its start.
inline std::shared_ptr<SceneState> builtin(const std::string& name, const std::string& parameters = "{}",
                                           Playback playback = Playback::Frozen) {
    return evaluated(makeBuiltinScene(name, parseYaml(parameters, "scene")), 0, playback);
}

/// A built-in scene with all its materials changed.
template <typename Change>
State withMaterials(const std::string& scene, const std::string& parameters, const Change& change) {
    const auto copy = builtinScene(scene, parameters);
    for (Material& material : copy->materials) change(material);
    return evaluated(copy);
}

/// A sphere of 1 m that reflects 0.6, with a lamp of 1 W/sr in its center: 1 W/m² everywhere.
inline State litSphere() {
    const auto sphere = builtinScene("furnace", "{albedo: 0.6, emission: 0}");
    sphere->lights.resize(1);
    return evaluated(sphere);
}

/// A room with a lamp of 1 W/sr in its center, which shines into a cone of so many degrees round its axis.
inline State roomWithSpot(double coneDegrees) {
    const auto state = builtin("white_room");
    Light& light = state->lights.at(0);
    light.type = LightType::Spot;
    light.direction = glm::normalize(glm::vec3(1, 2, 0.5f));
    light.outerConeAngle = float(glm::radians(coneDegrees));
    light.innerConeAngle = light.outerConeAngle - 0.01f;
    return state;
}

/// Cuts all surfaces of a scene away by an alpha mask.
inline std::shared_ptr<Scene> cutAway(std::shared_ptr<Scene> scene) {
    for (Material& material : scene->materials) {
        material.alphaMode = AlphaMode::Mask;
        material.baseColor.a = 0;
        material.alphaCutoff = 0.5f;
    }
    return scene;
}

/// Cornell with a ball that swings.
inline std::shared_ptr<const Scene> cornellWithBall(const MovingSpheres& ball) {
    const auto scene = builtinScene("cornell", "{lights: point}");
    addMovingSpheres(*scene, ball);
    return scene;
}

/// Cornell with a ball that swings between the walls, once in four seconds.
inline std::shared_ptr<const Scene> cornellWithSwingingBall() {
    return cornellWithBall({.radius = 0.12f, .center = {0, 1.3f, 0.2f}, .swing = {0.85f, 0, 0}, .period = 4});
}

/// Adds a sphere that is in the next of `path` each second.
inline void addMovingSphere(Scene& scene, uint32_t material, const std::vector<glm::vec3>& path) {
    scene.meshes.push_back(sphereMesh("sphere", glm::vec3(0), 0.13f, 2, material, false, true));
    AnimationChannel channel;
    channel.node = uint32_t(scene.nodes.size());
    for (const glm::vec3& place : path) {
        channel.timesSeconds.push_back(float(channel.timesSeconds.size()));
        channel.values.push_back(glm::vec4(place, 0));
    }
    scene.nodes.emplace_back();
    scene.animation.push_back(channel);
    scene.instances.push_back({uint32_t(scene.meshes.size() - 1), int32_t(channel.node)});
}

}  // namespace voxray::test
