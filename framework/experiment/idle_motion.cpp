#include "experiment/idle_motion.h"

#include <algorithm>

#include "config/overrides.h"

namespace voxray {

void IdleMotion::look(const Variant& variant, const Scene& scene) {
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

void IdleMotion::refuse() const {
    for (const auto& [path, use] : uses_)
        if (!use.hasEffect) throw UsageError(use.where, "{}: no effect: {}", path, use.why);
}

}  // namespace voxray
