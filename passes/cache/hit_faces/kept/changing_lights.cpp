#include "passes/cache/hit_faces/kept/changing_lights.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "passes/common/compute/bit_words.h"
#include "scene/panes.h"

namespace voxray {
namespace {

/// Sources that shine in this frame: of those that the pass knows, without lights that are off.
std::vector<LightSource> shiningSources(const std::vector<LightSource>& sources, const SceneState& scene) {
    std::vector<LightSource> shining;
    for (const LightSource& source : sources)
        if (source.kind != LightSource::Punctual || scene.lights[source.light].intensity != glm::vec3(0.0f))
            shining.push_back(source);
    return shining;
}

/// As SurfelDirectLight traces them.
uint32_t shadowRays(const std::vector<LightSource>& sources, uint32_t samples) {
    uint32_t rays = 0;
    for (const LightSource& source : sources) rays += source.kind == LightSource::Punctual ? 1 : samples;
    return rays;
}

}  // namespace

ChangingLights::ChangingLights(ProgramOwner& owner) : agePoints_(owner, "age_points.comp") {}

void ChangingLights::clear(const PassContext& context) {
    lights_ = context.scene.uploadedLights;
    hasChanged_.assign(lights_.size(), false);
}

uint32_t ChangingLights::hiddenWords() const {
    return std::max(uint32_t(bitWords(lights_.size())), 1u);
}

LightsOfPoints ChangingLights::toMeasure(const PointBatch& batch, const SceneState& scene) const {
    LightsOfPoints lights;
    bool allHaveRays = true;
    for (const LightSource& source : shadowRaySources(shiningSources(batch.sources, scene), scene)) {
        const bool isOwn = source.kind == LightSource::Punctual;
        (isOwn ? lights.all.own : lights.all.others).push_back(source);
        allHaveRays = allHaveRays && source.kind != LightSource::Tree;
    }
    lights.all.rays = shadowRays(lights.all.own, batch.samples) + shadowRays(lights.all.others, batch.samples);
    // Behind panes, and of lights that are sampled together, it is not known what part of a point's light is whose
    if (dimsLight(scene) || !allHaveRays) {
        lights.again = lights.all;
    } else {
        std::ranges::copy_if(lights.all.own, std::back_inserter(lights.again.own),
                             [&](const LightSource& source) { return hasChanged_[source.light]; });
        lights.again.keepsLight = true;
        lights.again.rays = uint32_t(lights.again.own.size());
    }
    return lights;
}

void ChangingLights::agePoints(PassContext& context, const PointBatch& batch, uint32_t faces, uint32_t pointsPerFace,
                               const std::vector<Binding>& ofPoints) {
    const std::vector<gpu::GpuLight>& now = context.scene.uploadedLights;
    if (now.size() != lights_.size()) throw Error("light that is kept: the number of lights has changed");
    std::vector<uint32_t> changed;
    for (uint32_t i = 0; i < now.size(); ++i)
        if (std::memcmp(&now[i], &lights_[i], sizeof(gpu::GpuLight)) != 0) changed.push_back(i);
    for (const uint32_t light : changed) hasChanged_[light] = true;
    const std::vector<gpu::GpuLight> before = std::exchange(lights_, now);
    if (changed.empty() || faces == 0) return;
    const Buffer lightsBefore(context.device, "lights before", now.size() * sizeof(gpu::GpuLight));
    const Buffer changedLights(context.device, "changed lights", changed.size() * sizeof(uint32_t));
    context.stream.upload(lightsBefore, before);
    context.stream.upload(changedLights, changed);
    const SceneState& scene = *context.frame.scene;
    const auto traced = shadowRaySources(batch.sources, scene);
    const bool sharesRays =
        std::ranges::any_of(traced, [](const LightSource& source) { return source.kind == LightSource::Tree; });
    context.dispatch(agePoints_, faces,
                     {context.scene,
                      {"lightsBefore", lightsBefore},
                      {"changedLights", changedLights},
                      ofPoints,
                      {"faces", faces},
                      {"pointsPerFace", pointsPerFace},
                      {"words", hiddenWords()},
                      {"changed", uint32_t(changed.size())},
                      {"isSure", !sharesRays && !dimsLight(scene)}});
    context.stream.finish();
}

}  // namespace voxray
