#include "experiment/checks/unused_settings.h"

#include <algorithm>
#include <set>

#include "config/overrides.h"
#include "scene/animation.h"

namespace voxray {

void refuseUnusedParameters(const Study& study) {
    // A parameter in the value of a swept pass is checked for each combination of swept passes
    const std::vector<std::string> keys = sweepKeys(study.experiment);
    const auto keyOf = [&](const Variant& variant, const std::string& path, const TextLocation& where) {
        std::vector<std::string> key{path, where.str()};
        for (size_t a = 0; a < keys.size(); ++a)
            if (keys[a].find('.') == std::string::npos) key.push_back(variant.values[a]);
        return key;
    };

    std::map<std::vector<std::string>, UnusedSetting> unused;
    std::set<std::string> paths;
    for (const Variant& variant : study.variants)
        for (const UnusedSetting& parameter : variant.unused) {
            paths.insert(parameter.name);
            unused.emplace(keyOf(variant, parameter.name, parameter.where), parameter);
        }
    if (unused.empty()) return;
    std::set<std::vector<std::string>> effective;
    for (const Variant& variant : study.variants)
        for (const Value& pass : variant.setup.graph.items)
            for (const auto& [key, value] : pass.members) {
                const std::string path = passId(pass) + "." + key;
                if (paths.contains(path) && std::ranges::count(variant.unused, path, &UnusedSetting::name) == 0)
                    effective.insert(keyOf(variant, path, value.where));
            }
    for (const auto& [key, parameter] : unused)
        if (!effective.contains(key))
            throw UsageError(parameter.where, "{}: {}; leave it out", parameter.name, parameter.why);
}

void UnusedMotionSettings::add(const Variant& variant, const Scene& scene) {
    const auto addUse = [&](const std::string& path, bool hasEffect, const char* why) {
        Use& use = uses_.try_emplace(path, Use{false, locationOf(variant.config, path), why}).first->second;
        use.hasEffect = use.hasEffect || hasEffect;
    };
    const SceneSettings& settings = variant.setup.scene;
    const bool hasAnimation = isAnimated(scene);
    const char* nothing =
        "nothing in the scene is animated: leave it out, or add 'moving_spheres', or a 'swing' to an entry of 'add'";
    if (settings.options.time > 0) addUse("scene.time", hasAnimation, nothing);
    if (settings.options.timeStep > 0 && !hasAnimation) addUse("scene.time_step", false, nothing);

    // Motion from frame to frame
    const bool hasFrames = measure_.frames + measure_.warmup > 1;
    const char* single = "there is one frame, in which nothing moves: raise measure.frames, or leave it out";
    const auto moves = [](const ConfigLight& light) { return light.move != glm::vec3(0.0f); };
    if (settings.options.timeStep > 0 && hasAnimation) addUse("scene.time_step", hasFrames, single);
    if (settings.camera && settings.camera->move != glm::vec3(0.0f)) addUse("scene.camera.move", hasFrames, single);
    if (settings.camera && !settings.camera->path.empty())
        addUse("scene.camera.path", measure_.frames > 1,
               "there is one measured frame, in which the path begins: raise measure.frames, or leave it out");
    if (std::ranges::any_of(settings.lights, moves)) addUse("scene.lights", hasFrames, single);
}

void UnusedMotionSettings::throwIfAny() const {
    for (const auto& [path, use] : uses_)
        if (!use.hasEffect) throw UsageError(use.where, "{}: no effect: {}", path, use.why);
}

}  // namespace voxray
