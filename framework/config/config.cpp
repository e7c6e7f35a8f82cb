#include "config/config.h"

#include <algorithm>
#include <cctype>

#include "config/overrides.h"
#include "config/yaml.h"
#include "image/score.h"

namespace voxray {
namespace {

// A results folder is named after the experiment.
void checkName(const Value& config, const std::string& name) {
    const Value* at = config.find("name");
    const TextLocation where = at ? at->where : config.where;
    if (name.empty()) throw UsageError(where, "name: an experiment needs a name");
    const bool isPlain = name.size() <= 100 && name[0] != '.' && name[0] != '-' &&
                         std::all_of(name.begin(), name.end(), [](unsigned char c) {
                             return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                                    (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || c == '.';
                         });
    if (!isPlain)
        throw UsageError(where,
                         "name: '{}' can't name a folder; use up to 100 letters, digits, '_', '-', '.'",
                         oneLine(name, 60));
}

// Ids share the first part of override paths with the config's keys.
void checkGraph(const Value& graph) {
    if (!graph.isList() || graph.items.empty())
        throw UsageError(graph.where, "graph: expected a list of passes, as in [{{pass: gbuffer}}]");
    for (const Value& entry : graph.items) {
        const std::string id = passId(entry);
        if (!entry.isMap() || id.empty())
            throw UsageError(entry.where, "graph: expected a map with 'pass', as in {{pass: gbuffer}}");
        if (id.find('.') != std::string::npos)
            throw UsageError(entry.where, "graph: the id '{}' must not contain a dot", id);
        const auto& keys = configKeys();
        if (std::find(keys.begin(), keys.end(), id) != keys.end())
            throw UsageError(entry.where, "graph: the id '{}' is a key of the config; choose another", id);
    }
}

// Masks name columns of results.csv and pictures.
std::vector<MaskSettings> readMasks(const Value& map) {
    if (!map.isMap())
        throw UsageError(
            map.where,
            "measure.masks: expected a map of conditions by name, as in {{floor: {{material: stone}}}}");
    std::vector<MaskSettings> masks;
    for (const auto& [name, conditions] : map.members) {
        const bool isPlain =
            !name.empty() && name.size() <= 50 && std::ranges::all_of(name, [](unsigned char c) {
                return std::isalnum(c) || c == '_' || c == '-';
            });
        if (!isPlain)
            throw UsageError(conditions.where,
                             "measure.masks: '{}' can't name a mask; use up to 50 letters, digits, '_', '-'",
                             name);
        if (!conditions.isMap() || conditions.members.empty())
            throw UsageError(conditions.where,
                             "measure.masks.{}: expected conditions, as in {{material: stone}}", name);
        MaskSettings mask = readParams<MaskSettings>(conditions, "measure.masks." + name);
        mask.name = name;
        mask.where = conditions.where;
        masks.push_back(std::move(mask));
    }
    return masks;
}

MeasureSettings readMeasure(const Value& map) {
    Value scalars = map;
    scalars.erase("metrics");
    scalars.erase("masks");
    MeasureSettings measure = readParams<MeasureSettings>(scalars, "measure");
    if (measure.compareEvery > 0 && comparedFrames(measure) < 3)
        throw UsageError(map.find("compare_every")->where,
                         "measure.compare_every: {} compares {} of {} frames; temporal error needs at least "
                         "3: raise 'frames'",
                         measure.compareEvery, comparedFrames(measure), measure.frames);
    if (const Value* masks = map.find("masks"); masks && !masks->isNull()) measure.masks = readMasks(*masks);
    const Value* list = map.find("metrics");
    if (!list) {
        measure.metrics = metricNames();
        return measure;
    }
    if (!list->isList())
        throw UsageError(list->where, "measure.metrics: expected a list, as in [flip, relmse]");
    for (const Value& item : list->items) {
        const std::string name = item.asString("measure.metrics");
        const std::vector<std::string> names = metricNames();
        if (std::find(names.begin(), names.end(), name) == names.end())
            throw UsageError(item.where, "measure.metrics: unknown metric '{}'{}", name,
                             didYouMean(name, names));
        measure.metrics.push_back(name);
    }
    return measure;
}

void checkSweep(const Value& sweep) {
    if (!sweep.isMap()) throw UsageError(sweep.where, "sweep: expected a map of lists");
    for (const auto& [path, values] : sweep.members)
        if (values.items.empty() && values.members.empty())
            throw UsageError(
                values.where,
                "sweep.{}: expected a list of values, as in [64, 128], or a map of names and values", path);
    // A map of names, not one value that is a map
    for (const auto& [path, values] : sweep.members)
        for (const char* key : {"pass", "builtin", "file"})
            if (values.find(key))
                throw UsageError(values.where,
                                 "sweep.{}: '{}' is part of a value: write it in a list, as in [{}]", path,
                                 key, values.text());
}

void checkTopLevel(const Value& config) {
    if (!config.isMap()) throw UsageError(config.where, "a config is a map; see docs/writing-a-config.md");
    for (const auto& [key, value] : config.members) {
        const auto& keys = configKeys();
        if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
        if (const std::string path = pathOfKey(key); !path.empty())
            throw UsageError(value.where, "unknown key '{}'; it stands in '{}'", key,
                             path.substr(0, path.find('.')));
        throw UsageError(value.where, "unknown key '{}'{}", key, didYouMean(key, keys));
    }
    if (const Value* profiles = config.find("profiles");
        profiles && !profiles->isMap() && !profiles->isNull())
        throw UsageError(profiles->where, "profiles: expected a map of named overrides");
}

Experiment readWithOptions(const Value& root, const ConfigOptions& options) {
    checkTopLevel(root);

    // A profile that can't be read is an error even when nobody asks for it
    if (const Value* profiles = root.find("profiles")) {
        for (const auto& member : profiles->members) {
            Value config = root;
            applyProfile(config, member.key);
            readExperiment(std::move(config));
        }
    }
    Value config = root;
    if (!options.profile.empty()) applyProfile(config, options.profile);
    for (const std::string& assignment : options.assignments) applyAssignment(config, assignment);
    return readExperiment(std::move(config));
}

}  // namespace

uint32_t comparedFrames(const MeasureSettings& settings) {
    return settings.compareEvery == 0 ? 1 : (settings.frames - 1) / settings.compareEvery + 1;
}

std::vector<std::string> metricNames() {
    std::vector<std::string> names;
    for (const Metric& metric : metrics()) names.emplace_back(metric.name);
    return names;
}

Setup readSetup(const Value& config) {
    Setup setup;
    const auto require = [&](const char* key) -> const Value& {
        const Value* value = config.find(key);
        if (!value) throw UsageError(config.where, "'{}' is missing; see docs/writing-a-config.md", key);
        return *value;
    };
    Value general = Value::map();
    for (const std::string& key : fieldNames<GeneralSettings>())
        if (const Value* value = config.find(key)) general.set(key, *value);
    setup.general = readParams<GeneralSettings>(general, "");
    checkName(config, setup.general.name);
    setup.scene = readSceneSettings(require("scene"));
    if (const Value* image = config.find("image")) setup.image = readParams<ImageSettings>(*image, "image");
    setup.graph = require("graph");
    checkGraph(setup.graph);
    return setup;
}

Experiment readExperiment(Value config) {
    config.erase("profiles");
    checkTopLevel(config);
    Experiment experiment;
    experiment.setup = readSetup(config);
    if (const Value* measure = config.find("measure"))
        experiment.measure = readMeasure(*measure);
    else
        experiment.measure.metrics = metricNames();
    if (const Value* sweep = config.find("sweep"); sweep && !sweep->isNull()) {
        checkSweep(*sweep);
        experiment.sweep = *sweep;
    }
    if (const Value* reference = config.find("reference"); reference && !reference->isNull()) {
        if (!reference->isMap() || passId(*reference).empty())
            throw UsageError(reference->where,
                             "reference: expected a map with 'pass', as in {{pass: path_trace, spp: 64}}");
        experiment.reference = *reference;
    }
    experiment.config = std::move(config);
    return experiment;
}

Experiment parseExperiment(const std::string& yaml, const std::string& fileName,
                           const ConfigOptions& options) {
    return readWithOptions(parseYaml(yaml, fileName), options);
}

Experiment loadExperiment(const std::filesystem::path& path, const ConfigOptions& options) {
    Experiment experiment = readWithOptions(readYaml(path), options);
    experiment.file = path;
    return experiment;
}

std::vector<std::string> profileNames(const std::filesystem::path& path) {
    std::vector<std::string> names;
    const Value config = readYaml(path);
    if (const Value* profiles = config.find("profiles"))
        for (const auto& member : profiles->members) names.push_back(member.key);
    return names;
}

}  // namespace voxray
