#include "experiment/checks/unused_settings.h"

#include <algorithm>
#include <set>

#include "config/overrides.h"

namespace voxray {

void refuseUnusedParameters(const Study& study) {
    // Sweeps over whole passes bring parameters of their own: each choice of them is looked at alone
    const std::vector<std::string> keys = sweepKeys(study.experiment);
    const auto placeOf = [&](const Variant& variant, const std::string& path, const TextLocation& where) {
        std::vector<std::string> place{path, where.str()};
        for (size_t a = 0; a < keys.size(); ++a)
            if (keys[a].find('.') == std::string::npos) place.push_back(variant.values[a]);
        return place;
    };

    std::map<std::vector<std::string>, UnusedSetting> unused;
    std::set<std::string> paths;
    for (const Variant& variant : study.variants)
        for (const UnusedSetting& parameter : variant.unused) {
            paths.insert(parameter.name);
            unused.emplace(placeOf(variant, parameter.name, parameter.where), parameter);
        }
    if (unused.empty()) return;
    std::set<std::vector<std::string>> working;
    for (const Variant& variant : study.variants)
        for (const Value& pass : variant.setup.graph.items)
            for (const auto& [key, value] : pass.members) {
                const std::string path = passId(pass) + "." + key;
                if (paths.contains(path) &&
                    std::ranges::count(variant.unused, path, &UnusedSetting::name) == 0)
                    working.insert(placeOf(variant, path, value.where));
            }
    for (const auto& [place, parameter] : unused)
        if (working.count(place) == 0)
            throw UsageError(parameter.where, "{}: {}; leave it out", parameter.name, parameter.why);
}

void UnusedMotion::look(const Variant& variant, const Scene& scene) {
    const auto note = [&](const std::string& path, bool hasEffect, const char* why) {
        Use& use = uses_.try_emplace(path, Use{false, locationOf(variant.config, path), why}).first->second;
        use.hasEffect = use.hasEffect || hasEffect;
    };
    const SceneSettings& settings = variant.setup.scene;
    const bool isAnimated = !scene.animation.empty();
    const char* nothing =
        "nothing in the scene is animated: leave it out, or add 'moving_spheres' to the scene";
    if (settings.options.time > 0) note("scene.time", isAnimated, nothing);
    if (settings.options.timeStep > 0 && !isAnimated) note("scene.time_step", false, nothing);

    // From frame to frame
    const bool goesOn = measure_.frames + measure_.warmup > 1;
    const char* single = "there is one frame, in which nothing moves: raise measure.frames, or leave it out";
    const auto moves = [](const ConfigLight& light) { return light.move != glm::vec3(0.0f); };
    if (settings.options.timeStep > 0 && isAnimated) note("scene.time_step", goesOn, single);
    if (settings.camera && settings.camera->move != glm::vec3(0.0f))
        note("scene.camera.move", goesOn, single);
    if (std::ranges::any_of(settings.lights, moves)) note("scene.lights", goesOn, single);
}

void UnusedMotion::refuse() const {
    for (const auto& [path, use] : uses_)
        if (!use.hasEffect) throw UsageError(use.where, "{}: no effect: {}", path, use.why);
}

}  // namespace voxray
