#include "experiment/plan_checks.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <tuple>

#include "base/byte_units.h"
#include "base/interrupt.h"
#include "config/overrides.h"
#include "experiment/addition_check.h"
#include "experiment/idle_motion.h"
#include "experiment/light_cost.h"
#include "experiment/session.h"
#include "experiment/view_check.h"

namespace voxray {
namespace {

/// Where light begins in a variant: its first pass with a parameter `bounces`, with its place in the config.
struct Bounces {
    std::string id;
    TextLocation where;
    int64_t value;
};
std::optional<Bounces> bouncesOf(const WiredVariant& variant) {
    for (const Value& pass : variant.resolved.items)
        if (const Value* bounces = pass.find("bounces"))
            for (const Value& entry : variant.setup.graph.items)
                if (passId(entry) == passId(pass)) {
                    const Value* written = entry.find("bounces");
                    return Bounces{passId(pass), written ? written->where : entry.where,
                                   bounces->asInteger("bounces")};
                }
    return std::nullopt;
}

/// What to write where the indirect light of a variant and of the reference have different numbers of
/// bounces, unless the sweep varies them; else empty. Both graphs are planned.
std::string bounceDifference(const WiredVariant& variant, const WiredExperiment& wired,
                             const Graph& referenceGraph) {
    const auto* own = variant.graph.resource<FrameImage>("indirect");
    const auto* right = referenceGraph.resource<FrameImage>("indirect");
    const auto variesBounces = [](const auto& axis) { return axis.key.ends_with(".bounces"); };
    if (std::ranges::any_of(wired.experiment.sweep.members, variesBounces)) return {};
    if (!own || !right || !own->lightBounces || !right->lightBounces ||
        *own->lightBounces == *right->lightBounces)
        return {};
    const int64_t has = *own->lightBounces, wanted = *right->lightBounces;
    std::string advice = fmt::format("write 'bounces: {}' in the reference", has);

    // What comes after the first pass adds bounces of its own
    const std::optional<Bounces> first = bouncesOf(variant);
    if (first && has >= first->value && first->value + wanted - has >= 0)
        advice = fmt::format("write 'bounces: {}' in '{}', or {}", first->value + wanted - has, first->id,
                             advice.substr(6));
    const TextLocation where = first ? first->where : wired.experiment.reference.where;
    return UsageError(where, "indirect light has {} bounces, the reference's {}: {}", has, wanted, advice)
        .what();
}

/// What to say where much of the view is metal, whose light the reference has and a variant lacks; else "".
/// Both graphs are planned.
std::string missingLobes(const WiredVariant& variant, const Graph& referenceGraph, double metal) {
    constexpr double kMuch = 0.1;  // A few knobs of metal are no reason to leave a scene's gloss out.
    const auto* own = variant.graph.resource<FrameImage>("indirect");
    const auto* right = referenceGraph.resource<FrameImage>("indirect");
    if (metal < kMuch || !own || !right || own->hasSpecularLobes || !right->hasSpecularLobes) return {};
    return UsageError(
               variant.setup.scene.where,
               "scene: {:.0f} % of the surfaces in view are metal, which reflects by specular lobes alone: "
               "the reference "
               "has what they reflect of indirect light, and this variant lacks it; write 'materials: "
               "lambert' for a scene without lobes, or take gather_mirror, or gather_cones with 'specular'",
               100 * metal)
        .what();
}

/// What to say of a variant whose image lacks a part of the light that the reference has.
std::vector<std::string> missingLight(const WiredVariant& variant, const Registry& registry) {
    std::vector<std::string> texts;
    for (const Graph::Input& input : variant.graph.unboundInputs("final"))
        if (input.port == "direct" || input.port == "indirect")
            texts.push_back(
                UsageError(input.where,
                           "{0}: no pass before it writes '{1}', so that 'final' lacks {1} light, "
                           "which the reference has; these can: {2}",
                           input.id, input.port, fmt::join(registry.writersOf(input.port), ", "))
                    .what());
    return texts;
}

/// What to say of passes that go on from frame to frame, where frame 0 alone is compared.
std::vector<std::string> shortHistory(const WiredVariant& variant, const MeasureSettings& measure) {
    std::vector<std::string> texts;
    if (measure.compareEvery > 0) return texts;
    for (const Graph::PassInfo& pass : variant.graph.passes())
        if (pass.warmupFrames > measure.warmup)
            texts.push_back(
                UsageError(pass.where,
                           "{0}: it goes on from frame to frame, and {1} of the {2} frames that it "
                           "looks back on come before the one that is compared: write measure: "
                           "{{warmup: {2}}}, or compare a sequence with 'compare_every'",
                           pass.id, measure.warmup, pass.warmupFrames)
                    .what());
    return texts;
}

/// What to say where the config takes away lights that the scene does not have: mostly others are meant.
std::vector<std::string> lightsThatStay(const WiredVariant& variant, const Scene& scene) {
    if (variant.setup.scene.options.keepFileLights || !scene.lights.empty()) return {};
    return {
        UsageError(locationOf(variant.config, "scene.keep_file_lights"),
                   "scene.keep_file_lights: the scene has no punctual lights; what else shines stays: "
                   "'override: {{MATERIAL: {{emission: 0}}}}' puts out a surface, 'environment: none' the "
                   "sky")
            .what()};
}

/// What to say of spheres that are to move and have no time to.
std::vector<std::string> spheresThatStay(const WiredVariant& variant) {
    const SceneSettings& scene = variant.setup.scene;
    if (!scene.movingSpheres || scene.movingSpheres->count == 0 || scene.options.timeStep > 0) return {};
    return {UsageError(locationOf(variant.config, "scene.moving_spheres"),
                       "scene.moving_spheres: they stand still; for ones that move write 'time_step', the "
                       "seconds from one frame to the next, next to it")
                .what()};
}

/// What to say of a reference whose halves have different numbers of samples; else "".
std::string unequalHalves(const Experiment& experiment) {
    const Value* spp = experiment.reference.find("spp");
    if (!spp) return {};
    const int64_t samples = spp->asInteger("reference.spp");
    if (samples % 2 == 0) return {};
    return UsageError(
               spp->where,
               "reference.spp: of {} samples a pixel one half of the reference has {}, the other {}, and "
               "both count the same: write an even number, best a power of two",
               samples, samples / 2, samples - samples / 2)
        .what();
}

constexpr uint64_t kAnySize = std::numeric_limits<uint64_t>::max();

/// The reference's graph, planned once for variants in a row that share scene and size of the image.
class ReferencePlan {
 public:
    ReferencePlan(const Experiment& experiment, const Registry& registry, const DeviceInfo& device)
        : experiment_(experiment), registry_(registry), device_(device) {}

    /// @param scene the key of the frame's scene. @throws Error for what the reference refuses.
    const Graph& in(const Frame& frame, const std::string& scene) {
        const Place place{scene, frame.width, frame.height};
        if (graph_ && place == place_) return *graph_;
        graph_.reset();
        Graph graph = referenceGraph(experiment_, registry_);
        graph.plan(frame, device_, kAnySize);
        place_ = place;
        return graph_.emplace(std::move(graph));
    }

 private:
    using Place = std::tuple<std::string, uint32_t, uint32_t>;
    const Experiment& experiment_;
    const Registry& registry_;
    const DeviceInfo& device_;
    std::optional<Graph> graph_;
    Place place_;
};

/// A variant and the memory that it takes.
struct MemoryNeed {
    std::string variant;
    uint64_t bytes;
    std::string largest;  ///< Id of the pass that takes most.
};

MemoryNeed memoryNeedOf(const WiredVariant& variant, const std::vector<PassMemory>& memory) {
    const std::vector<Graph::PassInfo> passes = variant.graph.passes();
    size_t largest = 0;
    for (size_t i = 0; i < memory.size(); ++i)
        if (memory[i].bytes + memory[i].scratchBytes > memory[largest].bytes + memory[largest].scratchBytes)
            largest = i;
    return {variant.name, peakBytes(memory), passes.empty() ? "" : passes[largest].id};
}

/// @return what to warn of where some variants are over the config's limit, else "".
/// @throws UsageError with file and line where all are.
std::string overTheLimit(const Experiment& experiment, std::vector<MemoryNeed> needs) {
    const uint64_t limitMb = experiment.measure.memoryLimitMb;
    const auto isOver = [&](const MemoryNeed& need) { return limitMb > 0 && need.bytes > limitMb << 20; };
    const size_t over = size_t(std::ranges::count_if(needs, isOver));
    if (over == 0) return {};
    std::ranges::stable_sort(needs, {}, &MemoryNeed::bytes);
    const auto& [variant, bytes, largest] = *std::ranges::find_if(needs, isOver);
    const UsageError error(locationOf(experiment.config, "measure.memory_limit_mb"),
                           "measure.memory_limit_mb: {} MiB are too few for {} of {} variants: {} takes at "
                           "least {:.1f} MiB, the "
                           "largest part of it by '{}'",
                           limitMb, over, needs.size(), variant, double(bytes) / kMiB, largest);
    if (over == needs.size()) throw error;
    return error.what();
}

/// What to say of passes that run in no variant: first of one whose image is written over, for passes before
/// it mostly are left out for that.
std::vector<std::string> neverRun(const WiredExperiment& wired, const Registry& registry) {
    std::vector<std::string> ids;
    for (const auto& [id, count] : variantsWithout(wired))
        if (!runsSomewhere(wired, id) && std::ranges::count(wired.deselected, id) == 0) ids.push_back(id);
    const std::string first = overwrittenFinal(wired, registry);
    std::ranges::stable_partition(ids, [&](const std::string& id) { return id == first; });
    std::vector<std::string> texts;
    for (const std::string& id : ids) texts.push_back(whyNeverRun(wired, id, registry));
    return texts;
}

/// As checkView(), or what that found before. Warnings hold for one config alone, since they name its lines.
const ViewCheck& checkViewOnce(const Setup& setup, const std::string& sceneKey, const PreparedScene& prepared,
                               SceneLoader& loader, const Registry& registry) {
    const std::string anywhere = viewKey(setup, sceneKey), here = setup.scene.where.file + " " + anywhere;
    for (const std::string& key : {anywhere, here})
        if (const auto known = loader.views.find(key); known != loader.views.end()) return known->second;
    ViewCheck found = checkView(setup, prepared, registry.preview);
    return loader.views.emplace(found.warnings.empty() ? anywhere : here, std::move(found)).first->second;
}

}  // namespace

PlanCheck checkPlans(WiredExperiment& wired, SceneLoader& loader, const DeviceInfo& device,
                     const Registry& registry, std::optional<size_t> only) {
    const Experiment& experiment = wired.experiment;
    std::map<std::string, std::vector<std::string>> notices;  // What is said, of which variants.
    std::vector<MemoryNeed> needs;
    IdleMotion motion(experiment.measure);
    std::string key;
    double metal = 0;  // Part of the surfaces seen.
    std::optional<LightCost> lightCost;
    ReferencePlan reference(experiment, registry, device);
    PlanCheck found;
    const std::span<WiredVariant> all(wired.variants);
    for (WiredVariant& variant : only ? all.subspan(*only, 1) : all) {
        if (interruptRequested()) throw Interrupted();
        const auto say = [&](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) notices[text].push_back(variant.name);
        };
        // Variants in a row mostly share a scene
        std::string own = loader.key(variant.setup.scene);
        const PreparedScene& prepared = loader.prepareOnce(variant.setup.scene, own);
        if (own != key) {
            key = std::move(own);
            lightCost.emplace(prepared.state);
            checkMaskNames(experiment.measure.masks, *prepared.state.scene);
            const ViewCheck& view = checkViewOnce(variant.setup, key, prepared, loader, registry);
            metal = view.metal;
            say(view.warnings);
            say(additionWarnings(variant.setup.scene, prepared, loader));
        }
        const ImageSettings& image = variant.setup.image;
        if (!experiment.measure.masks.empty() && !wired.reference.isNull()) {
            const auto& masks = experiment.measure.masks;
            const auto [selections, isNew] = found.masks.try_emplace(maskKey(key, image));
            if (isNew) {
                selections->second =
                    selectPixels(masks, prepared.state, prepared.camera, image.width, image.height);
                say(maskWarnings(masks, selections->second, prepared.state));
            }
        }
        motion.look(variant, *prepared.state.scene);
        say(lightsThatStay(variant, *prepared.state.scene));
        say(spheresThatStay(variant));
        const Frame frame = frameOf(variant.setup, prepared, variant.setup.general.seed);
        try {
            needs.push_back(memoryNeedOf(variant, variant.graph.plan(frame, device, kAnySize)));
            say(lightCost->warnings(variant.graph.passes()));
            say(shortHistory(variant, experiment.measure));
            if (wired.reference.isNull()) continue;
            say(missingLight(variant, registry));
            const Graph& planned = reference.in(frame, key);
            if (std::string text = bounceDifference(variant, wired, planned); !text.empty()) say({text});
            if (std::string text = missingLobes(variant, planned, metal); !text.empty()) say({text});
        } catch (const Error& error) {
            throw UsageError("{}{}", error.what(),
                             wired.variants.size() > 1 ? fmt::format(" (variant {})", variant.name) : "");
        }
    }
    if (!only) motion.refuse();

    std::vector<std::string>& warnings = found.warnings;
    warnings = experiment.warnings;
    if (std::string text = unequalHalves(experiment); !text.empty()) warnings.push_back(std::move(text));
    if (std::string text = only ? "" : overTheLimit(experiment, std::move(needs)); !text.empty())
        warnings.push_back(std::move(text));
    for (std::string& text : neverRun(wired, registry)) warnings.push_back(std::move(text));
    for (const auto& [text, names] : notices)
        warnings.push_back(names.size() == 1
                               ? fmt::format("{} ({})", text, names[0])
                               : fmt::format("{} ({} and {} more)", text, names[0], names.size() - 1));
    return found;
}

}  // namespace voxray
