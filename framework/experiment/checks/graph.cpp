#include "experiment/checks/graph.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "base/suggest.h"
#include "config/overrides.h"
#include "experiment/checks/checks.h"
#include "graph/wiring.h"

namespace voxray {
namespace {

void checkPassName(const Value& pass, const Registry& registry) {
    for (const Value& item : pass.items) checkPassName(item, registry);  // The passes of a chain.
    const Value* name = pass.isMap() ? pass.find("pass") : &pass;
    if (name && name->isScalar()) registry.require(name->scalar, name->where);
}

/// Rejects `inject: {rays_per_light: [4096]}`: it has values of the pass, not of its parameter.
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

/// @param source the value of a port in `inputs` of a pass: "id" or "id.port".
/// @throws UsageError if no variant has a pass with that id and output.
void checkSource(const std::string& reader, const std::string& port, const Value& source,
                 const std::vector<Variant>& variants, const Registry& registry) {
    const std::string what = fmt::format("{}.inputs.{}", reader, port);
    const std::string text = source.asString(what);
    const size_t dot = text.find('.');
    const std::string id = text.substr(0, dot);
    const std::string output = dot == std::string::npos ? port : text.substr(dot + 1);
    std::set<std::string> ids, outputs;
    for (const Variant& variant : variants)
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

/// The name of the last pass of a chain, or of a single pass.
std::string lastPass(const Value& value) {
    const Value& last = value.isList() ? value.items.back() : value;
    return last.isMap() ? last.find("pass")->scalar : last.scalar;
}

/// Ids of passes that run in no variant.
std::set<std::string> unusedPassIds(const Study& study) {
    std::set<std::string> idle;
    for (const auto& [id, count] : cullCounts(study))
        if (!runsSomewhere(study, id)) idle.insert(id);
    return idle;
}

}  // namespace

void checkPassNames(const Experiment& experiment, const Registry& registry) {
    for (const Value& entry : experiment.setup.graph.items) checkPassName(entry, registry);
    for (const auto& [path, values] : experiment.sweep.members)
        for (const Value& entry : experiment.setup.graph.items)
            if (passId(entry) == path) {
                checkNestedAxis(entry, path, values, registry);
                for (const Value& value : sweepValues(values)) {
                    if (value.isScalar() && value.scalar.find_first_not_of("0123456789.") == std::string::npos)
                        throw UsageError(value.where,
                                         "sweep.{0}: '{1}' is no pass: "
                                         "to vary a parameter of '{0}', write {0}.PARAMETER: {2}",
                                         path, value.scalar, values.text());
                    checkPassName(value, registry);
                }
            }
}

void checkGraphWithoutSweep(const Experiment& experiment, const std::vector<Variant>& variants,
                            const Registry& registry) {
    for (const Value& entry : experiment.setup.graph.items) {
        if (!entry.find("pass")) continue;
        checkEntry(registry, entry);
        if (const Value* inputs = entry.find("inputs"))
            for (const auto& [port, source] : inputs->members)
                checkSource(passId(entry), port, source, variants, registry);
    }
}

void checkSweptPasses(const Study& study) {
    const auto& axes = study.experiment.sweep.members;
    for (size_t a = 0; a < axes.size(); ++a) {
        const auto isOfAxis = [&](const Value& entry) { return passId(entry) == axes[a].key; };
        if (std::ranges::none_of(study.experiment.setup.graph.items, isOfAxis)) continue;
        const auto isRun = [&](const std::string& label) {
            return std::ranges::any_of(study.variants, [&](const Variant& variant) {
                return variant.values[a] == label && std::ranges::count(variant.culledPasses, axes[a].key) == 0;
            });
        };
        const std::vector<std::string> labels = sweepLabels(axes[a].key, axes[a].value, study.registry->filterLabels());
        const auto run = std::ranges::find_if(labels, isRun);
        const auto idle = std::ranges::find_if_not(labels, isRun);
        if (run == labels.end() || idle == labels.end()) continue;
        const std::vector<Value> values = sweepValues(axes[a].value);
        const Value& wrong = values[size_t(idle - labels.begin())];
        const std::string right = lastPass(values[size_t(run - labels.begin())]);
        std::vector<std::string> ports;
        for (const PortDoc& port : study.registry->require(right, {}).ports)
            if (port.output) ports.push_back("'" + port.name + "'");
        throw UsageError(wrong.where,
                         "sweep.{}: '{}' is never run: no image depends on what it writes; "
                         "'{}' in its place writes {}: end a chain with a pass that does",
                         axes[a].key, lastPass(wrong), right, fmt::join(ports, ", "));
    }
}

void checkLightSwitchTimes(const SceneSettings& scene, const MeasureSettings& measure) {
    for (size_t i = 0; i < scene.lights.size(); ++i)
        if (const ConfigLight& light = scene.lights[i]; light.offAt >= measure.frames)
            throw UsageError(light.where,
                             "scene.lights[{}].off_at: {} is after the last frame, {}, so that it always shines: "
                             "lower it, or raise measure.frames",
                             i, light.offAt, measure.frames - 1);
}

std::string overwrittenPass(const Study& study) {
    const std::set<std::string> idle = unusedPassIds(study);
    if (idle.empty()) return {};
    for (const Variant& variant : study.variants)
        for (const Value& entry : variant.setup.graph.items) {
            const std::string id = passId(entry);
            if (!idle.contains(id) || std::ranges::count(variant.culledPasses, id) == 0) continue;
            const PassKind& kind = study.registry->require(entry.find("pass")->scalar, entry.where);
            const auto isImage = [](const PortDoc& port) { return port.output && port.name == kComparedImage; };
            if (std::ranges::any_of(kind.ports, isImage)) return id;
        }
    return {};
}

std::string whyNeverRun(const Study& study, const std::string& id) {
    const auto isCulled = [&](const Variant& v) { return std::ranges::count(v.culledPasses, id) > 0; };
    const auto variant = std::ranges::find_if(study.variants, isCulled);
    return Graph(*study.registry, variant->setup.graph).whyCulled(id);
}

void checkNoImageIsOverwritten(const Study& study) {
    const std::string id = overwrittenPass(study);
    if (!id.empty() && unusedPassIds(study).size() > 1) throw UsageError("{}", whyNeverRun(study, id));
}

/// Warns of passes that run in no variant. A pass whose image is overwritten comes first, since it is often
/// the reason why others are unused.
void unusedPasses(const Study& study, Diagnostics& found) {
    std::vector<std::string> ids;
    for (const std::string& id : unusedPassIds(study))
        if (std::ranges::count(study.excludedPasses, id) == 0) ids.push_back(id);
    const std::string first = overwrittenPass(study);
    std::ranges::stable_partition(ids, [&](const std::string& id) { return id == first; });
    for (const std::string& id : ids) found.push_back({{}, whyNeverRun(study, id), ""});
}

}  // namespace voxray
