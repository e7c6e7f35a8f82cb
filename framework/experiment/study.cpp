#include "experiment/study.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "config/overrides.h"
#include "experiment/checks/graph.h"
#include "experiment/checks/unused_settings.h"
#include "experiment/reference.h"

namespace voxray {
namespace {

/// The outputs of a variant that are compared with the reference.
std::vector<std::string> comparedPorts() {
    return {kComparedImage, kIndirectImage};
}

/// A swept value may replace pass `id` by a chain (a list of passes), the last of which takes over `id`.
/// @return the id of a pass of such a chain.
std::string idInChain(const Value& pass, bool isLast, const std::string& id) {
    return isLast ? id : pass.isMap() ? passId(pass) : pass.scalar;
}

/// Whether all passes of a chain that replaces `id` are culled in a variant.
/// @param value what replaces the pass; null if nothing does.
bool isChainCulled(const Variant& variant, const std::string& id, const Value& value) {
    const std::vector<Value> chain = value.isList() ? value.items : std::vector{value};
    for (size_t i = 0; i < chain.size(); ++i)
        if (std::ranges::count(variant.culledPasses, idInChain(chain[i], i + 1 == chain.size(), id)) == 0) return false;
    return true;
}

/// Why a swept parameter (an axis of the sweep) has no effect in a variant: no image depends on its pass, or it is
/// unused because of other parameters. Empty if it has an effect.
/// @param chosen the variant's value of the parameter.
std::string whyWithoutEffect(const Variant& variant, const std::string& parameter, const Value& chosen) {
    const size_t dot = parameter.find('.');
    const std::string id = parameter.substr(0, dot);
    const bool isPass = dot == std::string::npos;
    if (isChainCulled(variant, id, isPass ? chosen : Value())) return fmt::format("no image depends on '{}'", id);
    for (const UnusedSetting& unused : variant.unused)
        if (unused.name == parameter) return unused.why;
    return {};
}

/// Removes variants that differ from others only in swept parameters without effect.
/// @throws UsageError with file and line for a parameter that has no effect in any variant. If a pass overwrites
/// another's image, the error names that instead, as the likely cause.
void removeDuplicates(Study& study) {
    const std::vector<std::string> keys = sweepKeys(study.experiment);
    std::vector<std::map<std::string, Value>> valuesByLabel(keys.size());  // For each swept parameter.
    for (size_t a = 0; a < keys.size(); ++a) {
        const Value& swept = study.experiment.sweep.members[a].value;
        const std::vector<std::string> labels = sweepLabels(keys[a], swept, study.registry->filterLabels());
        std::vector<Value> all = sweepValues(swept);
        for (size_t i = 0; i < labels.size(); ++i) valuesByLabel[a].emplace(labels[i], std::move(all[i]));
    }
    std::set<std::vector<std::string>> unique;
    VariantNames names(study.experiment, study.registry->filterLabels());
    std::vector<std::string> reasons(keys.size());
    std::erase_if(study.variants, [&](Variant& variant) {
        for (size_t a = 0; a < keys.size(); ++a) {
            const auto chosen = valuesByLabel[a].find(variant.values[a]);
            if (chosen == valuesByLabel[a].end()) continue;  // The variant has no value of the parameter.
            const std::string why = whyWithoutEffect(variant, keys[a], chosen->second);
            if (why.empty()) continue;
            variant.values[a] = kNoValue;
            reasons[a] = why;
        }
        if (!unique.insert(variant.values).second) return true;
        names.name(variant);
        return false;
    });
    for (size_t a = 0; a < keys.size(); ++a)
        if (std::ranges::all_of(study.variants, [&](const auto& v) { return v.values[a] == kNoValue; })) {
            if (const std::string id = overwrittenPass(study); !id.empty())
                throw UsageError("{} (sweep.{} changes nothing: {})", whyNeverRun(study, id), keys[a], reasons[a]);
            throw UsageError(study.experiment.sweep.members[a].value.where,
                             "sweep.{}: changes nothing in any variant: {}", keys[a], reasons[a]);
        }
}

/// Checks the reference. @return its graph, a list of one pass, including all default values.
Value checkedReference(const Study& study) {
    const Experiment& experiment = study.experiment;
    const Registry& registry = *study.registry;
    if (experiment.reference.isNull()) return {};
    const Value* pass = experiment.reference.find("pass");
    const PassKind& kind = registry.require(pass->scalar, pass->where);
    for (const std::string& port : referencePorts())
        if (std::ranges::none_of(kind.ports, [&](const PortDoc& p) { return p.output && p.name == port; }))
            throw UsageError(experiment.reference.where,
                             "reference: '{}' renders no reference: it writes no '{}'; use path_trace", kind.name,
                             port);
    kind.create(experiment.reference, "reference");
    Value resolved = study.referenceGraph().resolved();
    // The reference's noise is computed from two halves of its samples
    if (const Value* spp = experiment.reference.find("spp"); spp && spp->asInteger("reference.spp") < 2)
        throw UsageError(spp->where,
                         "reference.spp: must be at least 2, best a power of two (e.g. 64): "
                         "noise is the difference of the two halves");
    if (const Value* light = experiment.reference.find("light"); light && light->scalar != "all")
        throw UsageError(
            light->where,
            "reference.light: must be 'all' or left out, because the reference needs direct and indirect light");
    return resolved;
}

}  // namespace

Variant::Variant(SweepPoint point, const Registry& registry)
    : SweepPoint(std::move(point)), graph(registry, setup.graph) {
    if (!graph.writes(kComparedImage))
        throw UsageError(setup.graph.where, "graph: no pass writes '{}', the image that is compared; these can: {}",
                         kComparedImage, fmt::join(registry.writersOf(kComparedImage), ", "));
    for (const char* part : kPartsOfLight) graph.checkReadsLatest(kComparedImage, part);
    unused = graph.unused();
    culledPasses = graph.cullUnused(comparedPorts());
    resolved = graph.resolved();
    for (const std::string& port : comparedPorts()) noiseParameters[port] = graph.noiseParameters(port);
}

Graph Study::referenceGraph() const {
    Value list = Value::list();
    list.where = experiment.reference.where;
    list.items.push_back(experiment.reference);
    Graph graph(*registry, list);
    graph.cullUnused(referencePorts());
    return graph;
}

Graph Study::graphOf(const Variant& variant) const {
    Graph graph(*registry, variant.setup.graph);
    graph.cullUnused(comparedPorts());
    return graph;
}

Study makeStudy(Experiment experiment, const Registry& registry) {
    checkPassNames(experiment, registry);
    Study study;
    study.registry = &registry;
    for (SweepPoint& point : expandSweep(experiment, registry.filterLabels())) {
        checkLightSwitchTimes(point.setup.scene, experiment.measure);
        study.variants.emplace_back(std::move(point), registry);
    }
    checkGraphWithoutSweep(experiment, study.variants, registry);
    study.experiment = std::move(experiment);
    study.reference = checkedReference(study);
    checkSweptPasses(study);
    removeDuplicates(study);
    checkNoImageIsOverwritten(study);
    refuseUnusedParameters(study);
    return study;
}

std::map<std::string, size_t> cullCounts(const Study& study) {
    std::map<std::string, size_t> counts;
    for (const Variant& variant : study.variants)
        for (const std::string& id : variant.culledPasses) ++counts[id];
    return counts;
}

bool runsSomewhere(const Study& study, const std::string& id) {
    return std::ranges::any_of(study.variants, [&](const Variant& variant) {
        return std::ranges::any_of(variant.resolved.items, [&](const Value& pass) { return passId(pass) == id; });
    });
}

}  // namespace voxray
