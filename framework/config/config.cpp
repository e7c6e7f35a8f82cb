#include "config/config.h"

#include <algorithm>

#include "base/suggest.h"
#include "config/overrides.h"
#include "config/yaml.h"
#include "scene/load.h"

namespace voxray {
namespace {

/// Checks the experiment's name, which is also that of the results folder.
void checkName(const Value& config, const std::string& name) {
    const Value* entry = config.find("name");
    const TextLocation where = entry ? entry->where : config.where;
    if (name.empty()) throw UsageError(where, "name: an experiment needs a name");
    const bool isPlain =
        name.size() <= 100 && name[0] != '.' && name[0] != '-' && std::ranges::all_of(name, [](unsigned char c) {
            return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' ||
                   c == '.';
        });
    if (!isPlain)
        throw UsageError(where, "name: '{}' can't name a folder; use up to 100 letters, digits, '_', '-', '.'",
                         oneLine(name, 60));
}

/// The first pass of a graph that was written as a map, as an entry of a list.
std::string firstEntry(const Value& graph) {
    if (graph.find("pass")) return graph.text();
    const auto& [name, parameters] = graph.members[0];
    Value entry = Value::map();
    entry.set("pass", Value::fromScalar(name));
    for (const auto& [key, value] : parameters.members) entry.set(key, value);
    return entry.text();
}

/// Checks ids, which must differ from config keys: both may be the first component of override paths.
void checkGraph(const Value& graph) {
    if (graph.isMap() && !graph.members.empty())
        throw UsageError(graph.where, "graph: expected a list of passes, each with a dash: write '- {}'",
                         firstEntry(graph));
    if (!graph.isList() || graph.items.empty())
        throw UsageError(graph.where, "graph: expected a list of passes, as in [{{pass: gbuffer}}]");
    for (const Value& entry : graph.items) {
        const std::string id = passId(entry);
        if (!entry.isMap() || id.empty())
            throw UsageError(entry.where, "graph: expected a map with 'pass', as in {{pass: gbuffer}}");
        if (id.find('.') != std::string::npos)
            throw UsageError(entry.where, "graph: the id '{}' must not contain a dot", id);
        if (id.find_first_of(" \t\n") != std::string::npos)
            throw UsageError(entry.where, "graph: the id '{}' must not contain a blank; write '_' for it", id);
        const auto& keys = configKeys();
        if (std::ranges::count(keys, id) > 0)
            throw UsageError(entry.where, "graph: the id '{}' is a key of the config; choose another", id);
    }
}

void checkSweep(const Value& sweep) {
    if (!sweep.isMap())
        throw UsageError(sweep.where, "sweep: expected a map of lists, as in {{voxelize.resolution: [64, 128]}}");
    for (const auto& [path, values] : sweep.members)
        if (values.items.empty() && values.members.empty())
            throw UsageError(values.where,
                             "sweep.{}: expected a list of values, as in [64, 128], or a map of names and values",
                             path);
    // Reject a map that is a value instead of a map of names
    for (const auto& [path, values] : sweep.members)
        for (const char* key : {"pass", "builtin", "file"})
            if (values.find(key))
                throw UsageError(values.where, "sweep.{}: '{}' is part of a value: write it in a list, as in [{}]",
                                 path, key, values.text());
}

/// Rejects top-level keys within a block, which are probably indented too far. A built-in scene may have a
/// parameter with that name.
void checkBlocks(const Value& config) {
    const auto& keys = configKeys();
    for (const char* name : {"scene", "image", "measure", "reference"}) {
        const Value* block = config.find(name);
        for (const auto& [key, value] : block ? block->members : std::vector<Value::Member>())
            if (std::ranges::count(keys, key) > 0 && !(value.isScalar() && block == config.find("scene")))
                throw UsageError(value.where,
                                 "{0}: '{1}' is a key of its own, next to '{0}': indent it as far as '{0}'", name, key);
    }
}

/// The id of the first pass, or "reference", with a parameter of that name; "" if there is none.
std::string passWith(const Value& config, const std::string& parameter) {
    const Value *graph = config.find("graph"), *reference = config.find("reference");
    for (const Value& entry : graph ? graph->items : std::vector<Value>())
        if (entry.find(parameter)) return passId(entry);
    return reference && reference->find(parameter) ? "reference" : "";
}

void checkTopLevel(const Value& config) {
    if (!config.isMap())
        throw UsageError(config.where, "a config is a map; see docs/writing-a-config.md{}",
                         config.isNull()   ? "; nothing is written here"
                         : config.isList() ? "; leave out the dashes of its keys"
                                           : "");
    for (const auto& [key, value] : config.members) {
        const auto& keys = configKeys();
        if (std::ranges::count(keys, key) > 0) continue;
        if (const std::string path = pathOfKey(key); !path.empty())
            throw UsageError(value.where, "unknown key '{}'; it stands in '{}'", key, path.substr(0, path.find('.')));
        if (const std::string pass = passWith(config, key); !pass.empty())
            throw UsageError(value.where, "unknown key '{}'; it stands in the pass '{}'", key, pass);
        if (const std::string option = optionFor(key); !option.empty())
            throw UsageError(value.where, "unknown key '{}'; it is said on the command line: {}", key, option);
        throw UsageError(value.where, "unknown key '{}'{}", key, didYouMean(key, keys));
    }
    checkBlocks(config);
    if (const Value* profiles = config.find("profiles"); profiles && !profiles->isMap() && !profiles->isNull())
        throw UsageError(profiles->where,
                         "profiles: expected a map of named overrides, as in {{small: {{image: {{width: 160}}}}}}");
}

bool hasReference(const Value& config) {
    const Value* reference = config.find("reference");
    return reference && !reference->isNull();
}

/// Rejects settings in the config's text that have no effect in any profile. It is no error if overrides
/// remove axes of the sweep or the reference. @param config with all overrides applied.
void checkEmptyBlocks(const Value& root, const Value& config) {
    if (const Value* sweep = root.find("sweep"); sweep && sweep->isMap() && sweep->members.empty())
        throw UsageError(sweep->where,
                         "sweep: an empty map varies nothing: "
                         "leave it out, or write paths and values, as in {{voxelize.resolution: [64, 128]}}");
    bool isCompared = hasReference(root) || hasReference(config);
    if (const Value* profiles = root.find("profiles"))
        for (const auto& profile : profiles->members)
            for (const auto& [path, value] : profile.value.members)
                isCompared = isCompared || (path.starts_with("reference") && !value.isNull());
    const Value* measure = root.find("measure");
    if (isCompared || !measure) return;
    for (const char* key : {"masks", "metrics", "second_seed", "compare_every"})
        if (const Value* value = measure->find(key);
            value && !value->isNull() && value->scalar != "false" && value->scalar != "0")
            throw UsageError(value->where,
                             "measure.{}: no effect without a 'reference' to compare with; add one, as in reference: "
                             "{{pass: path_trace, spp: 64}}, or leave it out",
                             key);
}

/// Whether the config has that value at `path` without the sweep. A pass's name alone means default
/// parameters.
bool hasValue(const Value& config, const std::string& path, const Value& value) {
    const Value* written = valueAt(config, path);
    if (!written || path.find('.') != std::string::npos || !written->find("pass")) return written && *written == value;
    Value existing = *written, swapped = value.isScalar() ? Value::map() : value;
    if (value.isScalar()) swapped.set("pass", value);
    existing.erase("id");
    swapped.erase("id");
    return existing == swapped;
}

/// Warns of axes in the config's text whose only value equals that in the graph or the scene. Axes that are
/// reduced to one value by a profile or --set are not reported, nor those in a pass or scene that another axis
/// replaces.
std::vector<std::string> axesWithoutEffect(const Value& root, const Experiment& experiment) {
    std::vector<std::string> warnings;
    const Value* sweep = root.find("sweep");
    for (const auto& [path, axis] : sweep ? sweep->members : std::vector<Value::Member>()) {
        const Value* effective = experiment.sweep.find(path);
        const size_t values = axis.items.size() + axis.members.size();
        if (values != 1 || !effective || effective->where.str() != axis.where.str()) continue;
        const Value& value = axis.isMap() ? axis.members[0].value : axis.items[0];
        const size_t dot = path.find('.');
        const bool isReplaced = dot != std::string::npos && experiment.sweep.find(path.substr(0, dot));
        if (!isReplaced && hasValue(experiment.config, path, value))
            warnings.push_back(UsageError(axis.where,
                                          "sweep.{}: its one value, {}, is the one that is written anyway, "
                                          "so that it varies nothing: write more values, or leave it out",
                                          path, value.text())
                                   .what());
    }
    return warnings;
}

/// Reads a config file. @throws UsageError for a scene file.
Value readConfig(const std::filesystem::path& path) {
    if (isSceneFile(path))
        throw UsageError(
            "{0}: a scene, not a config; "
            "'./voxray scene {0} --write-config {1}' writes one that compares methods in it, with a camera, "
            "see docs/tutorial.md",
            path.string(), path.stem().string() + ".yaml");
    return readYaml(path);
}

}  // namespace

Experiment readExperiment(const Value& root, const ConfigOptions& options) {
    checkTopLevel(root);

    // All profiles must be valid, also those that are not used
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
    Experiment experiment = readExperiment(std::move(config));
    checkEmptyBlocks(root, experiment.config);
    experiment.warnings = axesWithoutEffect(root, experiment);
    return experiment;
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
        experiment.measure = readMeasureSettings(*measure);
    else
        experiment.measure.metrics = metricNames();
    if (const Value* sweep = config.find("sweep"); sweep && !sweep->isNull()) {
        checkSweep(*sweep);
        experiment.sweep = *sweep;
    }
    if (const Value* reference = config.find("reference"); reference && !reference->isNull()) {
        if (!reference->isMap() || passId(*reference).empty()) {
            const Value* file = reference->find("file");
            throw UsageError(
                file ? file->where : reference->where,
                "reference: expected a map with 'pass', as in {{pass: path_trace, spp: 64}}{}",
                file ? fmt::format("; './voxray compare final.exr {}' compares a result with a picture", file->text())
                     : "");
        }
        experiment.reference = *reference;
    }
    experiment.config = std::move(config);
    return experiment;
}

Experiment parseExperiment(const std::string& yaml, const std::string& fileName, const ConfigOptions& options) {
    return readExperiment(parseYaml(yaml, fileName), options);
}

Experiment loadExperiment(const std::filesystem::path& path, const ConfigOptions& options) {
    Experiment experiment = readExperiment(readConfig(path), options);
    experiment.file = path;
    return experiment;
}

Experiment withConfig(const Experiment& experiment, Value config) {
    Experiment changed = readExperiment(std::move(config));
    changed.file = experiment.file;
    changed.warnings = experiment.warnings;
    return changed;
}

std::vector<std::string> profileNames(const std::filesystem::path& path) {
    std::vector<std::string> names;
    const Value config = readConfig(path);
    if (const Value* profiles = config.find("profiles"))
        for (const auto& member : profiles->members) names.push_back(member.key);
    return names;
}

}  // namespace voxray
