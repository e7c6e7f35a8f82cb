#include "experiment/prepared_experiment.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "experiment/parts.h"
#include "experiment/plan_checks.h"
#include "experiment/scene_files.h"

namespace voxray {
namespace {

// --tracer overrides the config.
void applyTracerOption(WiredExperiment& wired, const std::string& name) {
    if (name.empty()) return;
    Experiment& experiment = wired.experiment;
    if (experiment.sweep.find("tracer"))
        throw UsageError("--tracer {}: this config sweeps over the tracer", name);
    Value value = Value::map();
    value.set("tracer", Value::fromScalar(name));
    value.find("tracer")->where = {"--tracer", 0};
    const TracerKind kind = readParams<GeneralSettings>(value, "").tracer;
    experiment.setup.general.tracer = kind;
    for (WiredVariant& variant : wired.variants) variant.setup.general.tracer = kind;
}

/// Whether all that the experiment runs does without Vulkan.
bool runsOnHost(const WiredExperiment& wired, const Registry& registry) {
    const auto doesWithout = [&](const Graph& graph) {
        return std::ranges::none_of(graph.passes(), [&](const Graph::PassInfo& pass) {
            return registry.find(pass.kind)->needsDevice;
        });
    };
    return std::ranges::all_of(wired.variants, doesWithout, &WiredVariant::graph) &&
           (wired.reference.isNull() || doesWithout(referenceGraph(wired.experiment, registry)));
}

}  // namespace

PreparedExperiment::PreparedExperiment(WiredExperiment experiment, const RunOptions& options,
                                       const Registry& registry)
    : wired_(std::move(experiment)), options_(options), registry_(registry) {
    applyTracerOption(wired_, options.tracer);
    DeviceOptions device;
    device.name = options_.deviceName;
    device.validation = options_.validation;
    device.isHost = device.name.empty() && !device.validation && runsOnHost(wired_, registry_) &&
                    !whyNoDevice(listDevices()).empty();
    session_.emplace(device, options_.sourceRoot,
                     sceneFolders(options_.scenes, options_.sourceRoot, wired_.experiment.file));

    // Every scene, its parameters and files, before anything is rendered
    for (const Variant& variant : wired_.variants) {
        session_->loader().key(variant.setup.scene);
        session_->tracerName(variant.setup);
    }
    recordInputs();
    PlanCheck check =
        checkPlans(wired_, session_->loader(), session_->device().info(), registry_, ownVariant());
    warnings_ = std::move(check.warnings);
    session_->takeMasks(std::move(check.masks));
    session_->loader().forgetPrepared();
}

std::optional<size_t> PreparedExperiment::ownVariant() {
    if (options_.part.empty()) return std::nullopt;
    const Part part = partNamed(*this, options_.part);
    if (part.kind == Part::Kind::Merge) return std::nullopt;
    return part.variant;
}

void PreparedExperiment::recordInputs() {
    manifest_.wired = &wired_;
    for (const WiredVariant& variant : wired_.variants) {
        manifest_.sceneKeys[variant.name] = session_->loader().key(variant.setup.scene);
        manifest_.referenceHashes[variant.name] = session_->referenceHashOf(wired_, variant.setup);
    }
    std::vector<std::string> leftOut;
    for (const auto& [id, count] : variantsWithout(wired_))
        if (runsSomewhere(wired_, id)) leftOut.push_back(fmt::format("'{}' in {}", id, count));
    if (!leftOut.empty())
        manifest_.notes.push_back(
            fmt::format("passes without a use are left out: {} of {} variants: no image that is compared "
                        "depends on them there",
                        fmt::join(leftOut, ", "), wired_.variants.size()));
    if (!wired_.reference.isNull()) manifest_.referencePass = wired_.reference.items[0];
    manifest_.device = session_->device().info();
    manifest_.requestedDevice = options_.deviceName;
    manifest_.tracer = session_->tracerName(wired_.variants[0].setup);
    manifest_.validation = options_.validation;
    manifest_.version = VOXRAY_VERSION;
    manifest_.commit = commitOf(options_.sourceRoot);
    manifest_.started = utcNow();
}

std::vector<std::string> PreparedExperiment::warnings() const {
    std::vector<std::string> lines = session_->warnings();
    for (const std::string& warning : warnings_)
        if (std::ranges::count(lines, warning) == 0) lines.push_back(warning);
    return lines;
}

VariantInputs PreparedExperiment::inputsOf(const WiredVariant& variant) {
    const Value measure = writeParams(experiment().measure);
    std::string masks;
    for (const MaskSettings& mask : experiment().measure.masks)
        masks += mask.name + ": " + writeParams(mask).text() + " ";
    return {{"graph", variant.resolved.text()},
            {"scene", manifest_.sceneKeys.at(variant.name)},
            {"image", writeParams(variant.setup.image).text()},
            {"seed", std::to_string(variant.setup.general.seed)},
            {"reference", referenceHash(variant)},
            {"measure", measure.text()},
            {"masks", masks},
            {"tracer", session_->tracerName(variant.setup)},
            {"device", session_->device().info().name},
            {"driver", session_->device().info().driver}};
}

}  // namespace voxray
