#include "experiment/validate.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/suggest.h"
#include "config/overrides.h"
#include "experiment/reference.h"
#include "graph/wiring.h"

namespace voxray {
namespace {

/// What of a variant is compared with the reference.
std::vector<std::string> comparedPorts() {
    return {"final", "indirect"};
}

void checkPassName(const Value& pass, const Registry& registry) {
    for (const Value& item : pass.items) checkPassName(item, registry);  // A chain.
    const Value* name = pass.isMap() ? pass.find("pass") : &pass;
    if (name && name->isScalar()) registry.require(name->scalar, name->where);
}

/// `inject: {rays_per_light: [4096]}` names values of the whole pass; what was meant is one of its
/// parameters.
void checkNestedAxis(const Value& entry, const std::string& id, const Value& axis, const Registry& registry) {
    const auto isPass = [&](const Value& v) { return !v.isScalar() || registry.find(v.scalar); };
    const Value* pass = entry.find("pass");
    const PassKind* kind = pass && pass->isScalar() ? registry.find(pass->scalar) : nullptr;
    for (const auto& [key, values] : axis.members)
        for (const ParameterDoc& doc : kind ? kind->parameters : std::vector<ParameterDoc>())
            if (doc.name == key && values.isList() && !std::ranges::all_of(values.items, isPass))
                throw UsageError(values.where, "sweep.{0}: '{1}' is a parameter: write {0}.{1}: {2}", id, key,
                                 values.text());
}

// Names of passes, before the sweep's paths are looked up among their ids: a pass that is misspelt in the
// graph would else be told as a misspelt path.
void checkPassNames(const Experiment& experiment, const Registry& registry) {
    for (const Value& entry : experiment.setup.graph.items) checkPassName(entry, registry);
    for (const auto& [path, values] : experiment.sweep.members)
        for (const Value& entry : experiment.setup.graph.items)
            if (passId(entry) == path) {
                checkNestedAxis(entry, path, values, registry);
                for (const Value& value : sweepValues(values)) {
                    if (value.isScalar() &&
                        value.scalar.find_first_not_of("0123456789.") == std::string::npos)
                        throw UsageError(value.where,
                                         "sweep.{0}: '{1}' is no pass: to vary a parameter of '{0}', write "
                                         "{0}.PARAMETER: {2}",
                                         path, value.scalar, values.text());
                    checkPassName(value, registry);
                }
            }
}

/// @param source what `inputs` of a pass says for a port: "id" or "id.port".
/// @throws UsageError where no variant has a pass of that id, or none that writes it.
void checkSource(const std::string& reader, const std::string& port, const Value& source,
                 const std::vector<WiredVariant>& variants, const Registry& registry) {
    const std::string what = fmt::format("{}.inputs.{}", reader, port);
    const std::string text = source.asString(what);
    const size_t dot = text.find('.');
    const std::string id = text.substr(0, dot);
    const std::string output = dot == std::string::npos ? port : text.substr(dot + 1);
    std::set<std::string> ids, outputs;
    for (const WiredVariant& variant : variants)
        for (const Value& pass : variant.setup.graph.items) {
            ids.insert(passId(pass));
            if (passId(pass) != id) continue;
            for (const PortDoc& doc : registry.require(pass.find("pass")->scalar, pass.where).ports)
                if (doc.output) outputs.insert(doc.name);
        }
    if (!ids.contains(id))
        throw UsageError(source.where, "{}: no pass has the id '{}' in any variant{}", what, id,
                         didYouMean(id, std::vector(ids.begin(), ids.end())));
    if (!outputs.contains(output))
        throw UsageError(source.where, "{}: '{}' writes no '{}' in any variant{}", what, id, output,
                         didYouMean(output, std::vector(outputs.begin(), outputs.end())));
}

/// Values in the graph that a sweep replaces in every variant are read here alone.
void checkOwnValues(const Experiment& experiment, const std::vector<WiredVariant>& variants,
                    const Registry& registry) {
    for (const Value& entry : experiment.setup.graph.items) {
        if (!entry.find("pass")) continue;
        checkEntry(registry, entry, Graph::reservedKeys());
        if (const Value* inputs = entry.find("inputs"))
            for (const auto& [port, source] : inputs->members)
                checkSource(passId(entry), port, source, variants, registry);
    }
}

/// The id of a pass in the place of the pass `id`: a chain's last one takes that over.
std::string idInChain(const Value& pass, bool isLast, const std::string& id) {
    return isLast ? id : pass.isMap() ? passId(pass) : pass.scalar;
}

/// Whether a variant runs no pass that stands in the place of `id`: a parameter's pass, or a swept pass or
/// chain.
bool runsNothingOf(const WiredVariant& variant, const std::string& id, const Value& value) {
    const std::vector<Value> chain = value.isList() ? value.items : std::vector{value};
    for (size_t i = 0; i < chain.size(); ++i)
        if (std::ranges::count(variant.leftOut, idInChain(chain[i], i + 1 == chain.size(), id)) == 0)
            return false;
    return true;
}

/// Why an axis changes nothing in a variant: no image depends on its pass, or other parameters leave the
/// swept one without effect. Empty where it has one.
/// @param chosen the variant's value of the axis.
std::string whyWithoutEffect(const WiredVariant& variant, const std::string& axis, const Value& chosen) {
    const size_t dot = axis.find('.');
    const std::string id = axis.substr(0, dot);
    const bool isPass = dot == std::string::npos;
    if (runsNothingOf(variant, id, isPass ? chosen : Value()))
        return fmt::format("no image depends on '{}'", id);
    for (const IdleParameter& idle : variant.idle)
        if (idle.name == axis) return idle.why;
    return {};
}

/// The name of the pass that has the id where a value stands in place of a pass: a chain's last.
std::string lastPass(const Value& value) {
    const Value& last = value.isList() ? value.items.back() : value;
    return last.isMap() ? last.find("pass")->scalar : last.scalar;
}

/// A value of a sweep over whole passes whose pass runs in no variant, while another value's does: such as a
/// chain whose last pass is missing.
/// @throws UsageError with file and line.
void checkSwaps(const WiredExperiment& wired, const Registry& registry) {
    const auto& axes = wired.experiment.sweep.members;
    for (size_t a = 0; a < axes.size(); ++a) {
        const auto isOfAxis = [&](const Value& entry) { return passId(entry) == axes[a].key; };
        if (std::ranges::none_of(wired.experiment.setup.graph.items, isOfAxis)) continue;
        const auto isRun = [&](const std::string& label) {
            return std::ranges::any_of(wired.variants, [&](const WiredVariant& variant) {
                return variant.values[a] == label && std::ranges::count(variant.leftOut, axes[a].key) == 0;
            });
        };
        const std::vector<std::string> labels = sweepLabels(axes[a].value);
        const auto run = std::ranges::find_if(labels, isRun);
        const auto idle = std::ranges::find_if_not(labels, isRun);
        if (run == labels.end() || idle == labels.end()) continue;
        const std::vector<Value> values = sweepValues(axes[a].value);
        const Value& wrong = values[size_t(idle - labels.begin())];
        const std::string right = lastPass(values[size_t(run - labels.begin())]);
        std::vector<std::string> ports;
        for (const PortDoc& port : registry.require(right, {}).ports)
            if (port.output) ports.push_back("'" + port.name + "'");
        throw UsageError(wrong.where,
                         "sweep.{}: '{}' is never run: no image depends on what it writes; '{}' in its place "
                         "writes {}: end a chain with a pass that does",
                         axes[a].key, lastPass(wrong), right, fmt::join(ports, ", "));
    }
}

/// A light that goes off after the last frame never does.
/// @throws UsageError with file and line.
void checkLightsGoOff(const SceneSettings& scene, const MeasureSettings& measure) {
    for (size_t i = 0; i < scene.lights.size(); ++i)
        if (const ConfigLight& light = scene.lights[i]; light.offAt >= measure.frames)
            throw UsageError(light.where,
                             "scene.lights[{}].off_at: {} is after the last frame, {}, so that it always "
                             "shines: lower it, or raise measure.frames",
                             i, light.offAt, measure.frames - 1);
}

/// A swept parameter or pass that has no effect in a variant: such variants come once.
/// @throws UsageError with file and line for an axis that changes nothing in any variant; where a pass that
/// writes over another's `final` may be the reason, that is told first.
void leaveOutEqual(WiredExperiment& wired, const Registry& registry) {
    const std::vector<std::string> keys = sweepKeys(wired.experiment);
    std::vector<std::map<std::string, Value>> values(keys.size());  // Of each axis, by label.
    for (size_t a = 0; a < keys.size(); ++a) {
        const Value& axis = wired.experiment.sweep.members[a].value;
        const std::vector<std::string> labels = sweepLabels(axis);
        std::vector<Value> all = sweepValues(axis);
        for (size_t i = 0; i < labels.size(); ++i) values[a].emplace(labels[i], std::move(all[i]));
    }
    std::set<std::vector<std::string>> seen;
    VariantNames names(wired.experiment);
    std::vector<std::string> reasons(keys.size());
    std::erase_if(wired.variants, [&](WiredVariant& variant) {
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
        if (std::ranges::all_of(wired.variants, [&](const auto& v) { return v.values[a] == kNoValue; })) {
            if (const std::string id = overwrittenFinal(wired, registry); !id.empty())
                throw UsageError("{} (sweep.{} changes nothing: {})", whyNeverRun(wired, id, registry),
                                 keys[a], reasons[a]);
            throw UsageError(wired.experiment.sweep.members[a].value.where,
                             "sweep.{}: changes nothing in any variant: {}", keys[a], reasons[a]);
        }
}

/// @throws UsageError where a pass that writes over another's `final` leaves more passes than that one idle.
void checkIsNotOverwritten(const WiredExperiment& wired, const Registry& registry) {
    const std::string id = overwrittenFinal(wired, registry);
    if (id.empty()) return;
    for (const auto& [other, count] : variantsWithout(wired))
        if (other != id && !runsSomewhere(wired, other))
            throw UsageError("{}", whyNeverRun(wired, id, registry));
}

}  // namespace

Graph referenceGraph(const Experiment& experiment, const Registry& registry) {
    Value list = Value::list();
    list.where = experiment.reference.where;
    list.items.push_back(experiment.reference);
    Graph graph(registry, list);
    graph.keepOnly(referencePorts());
    return graph;
}

Graph variantGraph(const Variant& variant, const Registry& registry) {
    Graph graph(registry, variant.setup.graph);
    graph.keepOnly(comparedPorts());
    return graph;
}

WiredExperiment wireExperiment(Experiment experiment, const Registry& registry) {
    checkPassNames(experiment, registry);
    WiredExperiment wired;
    for (Variant& variant : expandSweep(experiment)) {
        checkLightsGoOff(variant.setup.scene, experiment.measure);
        Graph graph(registry, variant.setup.graph);
        if (!graph.writes("final"))
            throw UsageError(variant.setup.graph.where,
                             "graph: no pass writes 'final', the image that is compared; these can: {}",
                             fmt::join(registry.writersOf("final"), ", "));
        for (const char* part : {"direct", "indirect"}) graph.checkReadsLast("final", part);
        std::vector<IdleParameter> idle = graph.idle();
        std::vector<std::string> leftOut = graph.keepOnly(comparedPorts());
        Value resolved = graph.resolved();
        std::map<std::string, std::vector<std::string>> noise;
        for (const std::string& port : comparedPorts()) noise[port] = graph.noiseParameters(port);
        wired.variants.push_back({std::move(variant), std::move(graph), std::move(resolved),
                                  std::move(leftOut), std::move(noise), std::move(idle)});
    }
    checkOwnValues(experiment, wired.variants, registry);
    if (!experiment.reference.isNull()) {
        const Value* pass = experiment.reference.find("pass");
        const PassKind& kind = registry.require(pass->scalar, pass->where);
        for (const std::string& port : referencePorts())
            if (std::ranges::none_of(kind.ports,
                                     [&](const PortDoc& p) { return p.output && p.name == port; }))
                throw UsageError(experiment.reference.where,
                                 "reference: '{}' renders no reference: it writes no '{}'; use path_trace",
                                 kind.name, port);
        kind.resolve(experiment.reference, "reference", Graph::reservedKeys());
        const Graph graph = referenceGraph(experiment, registry);
        wired.reference = graph.resolved();
        // Of a single sample there are no halves, which tell the reference's noise
        if (const Value* spp = experiment.reference.find("spp"); spp && spp->asInteger("reference.spp") < 2)
            throw UsageError(
                spp->where,
                "reference.spp: 2 or more, best a power of two, as in spp: 64: from its two halves "
                "comes the reference's noise");
        if (const Value* light = experiment.reference.find("light"); light && light->scalar != "all")
            throw UsageError(light->where,
                             "reference.light: 'all', or left out: direct and indirect light are compared");
    }
    wired.experiment = std::move(experiment);
    checkSwaps(wired, registry);
    leaveOutEqual(wired, registry);
    checkIsNotOverwritten(wired, registry);
    checkIdleParameters(wired);
    return wired;
}

std::map<std::string, size_t> variantsWithout(const WiredExperiment& wired) {
    std::map<std::string, size_t> counts;
    for (const WiredVariant& variant : wired.variants)
        for (const std::string& id : variant.leftOut) ++counts[id];
    return counts;
}

std::string overwrittenFinal(const WiredExperiment& wired, const Registry& registry) {
    std::set<std::string> idle;  // Passes that run in no variant.
    for (const auto& [id, count] : variantsWithout(wired))
        if (!runsSomewhere(wired, id)) idle.insert(id);
    if (idle.empty()) return {};
    for (const WiredVariant& variant : wired.variants)
        for (const Value& entry : variant.setup.graph.items) {
            const std::string id = passId(entry);
            if (!idle.contains(id) || std::ranges::count(variant.leftOut, id) == 0) continue;
            const PassKind& kind = registry.require(entry.find("pass")->scalar, entry.where);
            const auto isFinal = [](const PortDoc& port) { return port.output && port.name == "final"; };
            if (std::ranges::any_of(kind.ports, isFinal)) return id;
        }
    return {};
}

std::string whyNeverRun(const WiredExperiment& wired, const std::string& id, const Registry& registry) {
    const auto lacks = [&](const WiredVariant& v) { return std::ranges::count(v.leftOut, id) > 0; };
    const auto variant = std::ranges::find_if(wired.variants, lacks);
    return Graph(registry, variant->setup.graph).whyLeftOut(id);
}

bool runsSomewhere(const WiredExperiment& wired, const std::string& id) {
    return std::ranges::any_of(wired.variants, [&](const WiredVariant& variant) {
        return std::ranges::any_of(variant.resolved.items,
                                   [&](const Value& pass) { return passId(pass) == id; });
    });
}

}  // namespace voxray
