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

/// What of a variant is compared with the reference.
std::vector<std::string> comparedPorts() {
    return {kComparedImage, kIndirectImage};
}

/// The id of a pass in the place of the pass `id`: a chain's last one takes that over.
std::string idInChain(const Value& pass, bool isLast, const std::string& id) {
    return isLast ? id : pass.isMap() ? passId(pass) : pass.scalar;
}

/// Whether a variant runs no pass that stands in the place of `id`: a parameter's pass, or a swept pass or
/// chain.
bool runsNothingOf(const Variant& variant, const std::string& id, const Value& value) {
    const std::vector<Value> chain = value.isList() ? value.items : std::vector{value};
    for (size_t i = 0; i < chain.size(); ++i)
        if (std::ranges::count(variant.leftOut, idInChain(chain[i], i + 1 == chain.size(), id)) == 0)
            return false;
    return true;
}

/// Why an axis changes nothing in a variant: no image depends on its pass, or other parameters leave the
/// swept one without effect. Empty where it has one.
/// @param chosen the variant's value of the axis.
std::string whyWithoutEffect(const Variant& variant, const std::string& axis, const Value& chosen) {
    const size_t dot = axis.find('.');
    const std::string id = axis.substr(0, dot);
    const bool isPass = dot == std::string::npos;
    if (runsNothingOf(variant, id, isPass ? chosen : Value()))
        return fmt::format("no image depends on '{}'", id);
    for (const UnusedSetting& unused : variant.unused)
        if (unused.name == axis) return unused.why;
    return {};
}

/// A swept parameter or pass that has no effect in a variant: such variants come once.
/// @throws UsageError with file and line for an axis that changes nothing in any variant; where a pass that
/// writes over another's image may be the reason, that is told first.
void leaveOutEqual(Study& study) {
    const std::vector<std::string> keys = sweepKeys(study.experiment);
    std::vector<std::map<std::string, Value>> values(keys.size());  // Of each axis, by label.
    for (size_t a = 0; a < keys.size(); ++a) {
        const Value& axis = study.experiment.sweep.members[a].value;
        const std::vector<std::string> labels = sweepLabels(axis);
        std::vector<Value> all = sweepValues(axis);
        for (size_t i = 0; i < labels.size(); ++i) values[a].emplace(labels[i], std::move(all[i]));
    }
    std::set<std::vector<std::string>> seen;
    VariantNames names(study.experiment);
    std::vector<std::string> reasons(keys.size());
    std::erase_if(study.variants, [&](Variant& variant) {
        for (size_t a = 0; a < keys.size(); ++a) {
            const auto chosen = values[a].find(variant.values[a]);
            if (chosen == values[a].end()) continue;  // It has none.
            const std::string why = whyWithoutEffect(variant, keys[a], chosen->second);
            if (why.empty()) continue;
            variant.values[a] = kNoValue;
            reasons[a] = why;
        }
        if (!seen.insert(variant.values).second) return true;
        variant.name = names.next(variant.values);
        return false;
    });
    for (size_t a = 0; a < keys.size(); ++a)
        if (std::ranges::all_of(study.variants, [&](const auto& v) { return v.values[a] == kNoValue; })) {
            if (const std::string id = overwrittenPass(study); !id.empty())
                throw UsageError("{} (sweep.{} changes nothing: {})", whyNeverRun(study, id), keys[a],
                                 reasons[a]);
            throw UsageError(study.experiment.sweep.members[a].value.where,
                             "sweep.{}: changes nothing in any variant: {}", keys[a], reasons[a]);
        }
}

/// The reference's graph as a list of one pass, its defaults filled in.
Value checkedReference(const Study& study) {
    const Experiment& experiment = study.experiment;
    const Registry& registry = *study.registry;
    if (experiment.reference.isNull()) return {};
    const Value* pass = experiment.reference.find("pass");
    const PassKind& kind = registry.require(pass->scalar, pass->where);
    for (const std::string& port : referencePorts())
        if (std::ranges::none_of(kind.ports, [&](const PortDoc& p) { return p.output && p.name == port; }))
            throw UsageError(experiment.reference.where,
                             "reference: '{}' renders no reference: it writes no '{}'; use path_trace",
                             kind.name, port);
    kind.create(experiment.reference, "reference");
    Value resolved = study.referenceGraph().resolved();
    // Of a single sample there are no halves, which tell the reference's noise
    if (const Value* spp = experiment.reference.find("spp"); spp && spp->asInteger("reference.spp") < 2)
        throw UsageError(spp->where,
                         "reference.spp: 2 or more, best a power of two, as in spp: 64: "
                         "from its two halves comes the reference's noise");
    if (const Value* light = experiment.reference.find("light"); light && light->scalar != "all")
        throw UsageError(light->where,
                         "reference.light: 'all', or left out: direct and indirect light are compared");
    return resolved;
}

}  // namespace

Variant::Variant(SweepPoint point, const Registry& registry)
    : SweepPoint(std::move(point)), graph(registry, setup.graph) {
    if (!graph.writes(kComparedImage))
        throw UsageError(setup.graph.where,
                         "graph: no pass writes '{}', the image that is compared; these can: {}",
                         kComparedImage, fmt::join(registry.writersOf(kComparedImage), ", "));
    for (const char* part : kPartsOfLight) graph.checkReadsLast(kComparedImage, part);
    unused = graph.unused();
    leftOut = graph.cullUnused(comparedPorts());
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
    for (SweepPoint& point : expandSweep(experiment)) {
        checkLightsGoOff(point.setup.scene, experiment.measure);
        study.variants.emplace_back(std::move(point), registry);
    }
    checkOwnValues(experiment, study.variants, registry);
    study.experiment = std::move(experiment);
    study.reference = checkedReference(study);
    checkSwaps(study);
    leaveOutEqual(study);
    checkIsNotOverwritten(study);
    refuseUnusedParameters(study);
    return study;
}

std::map<std::string, size_t> variantsWithout(const Study& study) {
    std::map<std::string, size_t> counts;
    for (const Variant& variant : study.variants)
        for (const std::string& id : variant.leftOut) ++counts[id];
    return counts;
}

bool runsSomewhere(const Study& study, const std::string& id) {
    return std::ranges::any_of(study.variants, [&](const Variant& variant) {
        return std::ranges::any_of(variant.resolved.items,
                                   [&](const Value& pass) { return passId(pass) == id; });
    });
}

}  // namespace voxray
