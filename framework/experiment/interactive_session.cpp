#include "experiment/interactive_session.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/interrupt.h"
#include "config/overrides.h"
#include "experiment/scene_files.h"
#include "scene/animation.h"

namespace voxray {
namespace {

DeviceOptions deviceOptions(const RunOptions& options) {
    DeviceOptions device;
    device.name = options.deviceName;
    device.validation = options.validation;
    return device;
}

/// A variant's config without parameters that other variants of the sweep need: alone they are refused as unused.
Value alone(const Variant& variant) {
    Value config = variant.config;
    for (const UnusedSetting& parameter : variant.unused) applyOverride(config, parameter.name, Value());
    return config;
}

}  // namespace

InteractiveSession::InteractiveSession(Experiment experiment, const Registry& registry, const RunOptions& options,
                                       const std::vector<std::string>& leftOut)
    : registry_(registry),
      opened_(std::move(experiment)),
      session_(deviceOptions(options), options.sourceRoot,
               sceneFolders(options.scenes, options.sourceRoot, opened_.file)),
      viewChecks_(options.previewTracer) {
    const Study all = makeStudy(opened_, registry_);
    for (const Variant& variant : all.variants) {
        if (std::ranges::count(leftOut, variant.name)) continue;
        variants_.emplace_back(variant.name, variant.id);
        variantConfigs_.push_back(alone(variant));
    }
    for (const auto& [id, count] : cullCounts(all))
        if (runsSomewhere(all, id)) idlePasses_.push_back(id);
    sweepsScene_ = std::ranges::any_of(sweepKeys(opened_), [](const auto& key) { return key.starts_with("scene."); });
    leaveOutIdleTime(variantConfigs_.front());
    sides_[0].emplace(*this, variantConfigs_.front(), variants_.front().second);
}

size_t InteractiveSession::indexOf(const std::string& variant) const {
    using Names = std::pair<std::string, std::string>;
    auto found = std::ranges::find(variants_, variant, &Names::second);
    if (found == variants_.end()) found = std::ranges::find(variants_, variant, &Names::first);
    if (found == variants_.end()) {
        std::vector<std::string> ids;
        for (const auto& [name, each] : variants_) ids.push_back(each);
        throw UsageError("no variant '{}'; there are {}", variant, fmt::join(ids, ", "));
    }
    return size_t(found - variants_.begin());
}

const std::string& InteractiveSession::idOf(const std::string& variant) const {
    return variants_[indexOf(variant)].second;
}

const Value& InteractiveSession::configOf(const std::string& variant) const {
    return variantConfigs_[indexOf(variant)];
}

const Value& InteractiveSession::configAlone(const std::string& variant) {
    Value& config = variantConfigs_[indexOf(variant)];
    leaveOutIdleTime(config);
    return config;
}

void InteractiveSession::leaveOutIdleTime(Value& config) {
    if (!sweepsScene_) return;
    const Setup setup = studyOf(config).variants.front().setup;
    const SceneOptions& options = setup.scene.options;
    if (options.time == 0 && options.timeStep == 0) return;
    session_.moveCamera(setup);  // So that the scene is found loaded
    const PreparedScene& scene = session_.loader().prepareCached(setup.scene, session_.loader().key(setup.scene));
    if (isAnimated(*scene.state.scene)) return;
    for (const char* path : {"scene.time", "scene.time_step"})
        if (valueAt(config, path)) applyOverride(config, path, Value());
}

ShownState& InteractiveSession::side(size_t number) {
    std::optional<ShownState>& side = sides_.at(number);
    if (!side) {
        side.emplace(*this, sides_[0]->config(), sides_[0]->variantId());
        session_.keepScenes(kSides);
    }
    return *side;
}

void InteractiveSession::closeSecondSide() {
    sides_[1].reset();
    session_.keepScenes(1);
    dropReferences();
}

bool InteractiveSession::isShown(const ProgressiveReference& reference) const {
    return std::ranges::any_of(sides_,
                               [&](const auto& side) { return side && side->referenceHash() == reference.hash(); });
}

ProgressiveReference& InteractiveSession::reference(const Study& study) {
    const std::string& hash = study.variants.front().referenceHash;
    for (auto& reference : references_)
        if (reference && reference->hash() == hash) return *reference;
    // There are as many as sides, so that the study's side has one left: that of its earlier values, if any
    auto free = std::ranges::find_if(references_, [&](const auto& one) { return one && !isShown(*one); });
    if (free == references_.end()) free = std::ranges::find_if(references_, [](const auto& one) { return !one; });
    if (!*free) free->emplace(session_);
    (*free)->follow(study);
    return **free;
}

void InteractiveSession::dropReferences() {
    for (auto& reference : references_)
        if (reference && !isShown(*reference)) reference.reset();
}

bool InteractiveSession::advanceReferences(std::chrono::milliseconds budget) {
    for (auto& side : sides_) {
        if (!side || !side->hasReference()) continue;
        try {
            const ProgressiveReference& reference = side->reference();
            if (reference.isWhole() || reference.hasFailed()) continue;
            side->advanceReference(budget);
        } catch (const Interrupted&) {
            throw;
        } catch (const Error&) {
            continue;  // hasFailed() tells it
        }
        return true;
    }
    return false;
}

Study InteractiveSession::studyOf(Value config) const {
    Study study = makeStudy(withConfig(opened_, std::move(config)), registry_);
    study.excludedPasses = idlePasses_;
    return study;
}

Study InteractiveSession::checkedStudy(Value config) {
    Study study = studyOf(std::move(config));
    for (Variant& variant : study.variants) {
        variant.sceneKey = session_.loader().key(variant.setup.scene);
        variant.referenceHash = session_.referenceHashOf(study, variant.setup);
        session_.moveCamera(variant.setup);  // So that checks find the scene loaded
    }
    const std::string scene = session_.cameralessKey(study.variants.front().setup);
    const auto known = std::ranges::find(checkedScenes_, scene);
    viewChecks_.setTracesNewViews(known == checkedScenes_.end());
    planVariants(study, session_.loader(), viewChecks_, session_.device().info());
    if (known != checkedScenes_.end()) checkedScenes_.erase(known);
    checkedScenes_.insert(checkedScenes_.begin(), scene);
    if (checkedScenes_.size() > kSides) checkedScenes_.pop_back();
    return study;
}

}  // namespace voxray
