#include "config/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/suggest.h"
#include "config/settings.h"
#include "config/yaml.h"

namespace voxray {
namespace {

/// Removes the first key and its dot from a path below `parent`. A name with dots is one key if `parent` has
/// it or if it is in double quotes.
std::string takeKey(const Value& parent, std::string_view& path) {
    const size_t quote = path.starts_with('"') ? path.find('"', 1) : std::string_view::npos;
    const bool isQuoted = quote != std::string_view::npos;
    size_t length = isQuoted ? quote + 1 : std::min(path.find('.'), path.size());
    if (!isQuoted)
        for (const auto& [key, value] : parent.members)
            if (key.size() > length && path.starts_with(key) && (path.size() == key.size() || path[key.size()] == '.'))
                length = key.size();
    const std::string key(isQuoted ? path.substr(1, quote - 1) : path.substr(0, length));
    path.remove_prefix(std::min(length + 1, path.size()));
    return key;
}

void setNested(Value& parent, const std::string& key, const Value& value, Merge merge);

void mergeInto(Value& target, const Value& value, Merge merge) {
    if (merge == Merge::Maps && target.isMap() && value.isMap()) {
        for (const auto& [key, member] : value.members) setNested(target, key, member, merge);
    } else {
        target = value;
    }
}

/// Sets a key of a map; null removes it. @throws UsageError where `{width:96}` stands for `{width: 96}`.
void setNested(Value& parent, const std::string& key, const Value& value, Merge merge) {
    if (value.isNull()) {
        if (const size_t colon = key.find(':'); colon != std::string::npos && !parent.find(key))
            throw UsageError(value.where,
                             "'{}': no key of that name; a space is missing after the colon, as in '{}: {}'", key,
                             key.substr(0, colon), key.substr(colon + 1));
        parent.erase(key);
    } else if (Value* existing = parent.find(key)) {
        mergeInto(*existing, value, merge);
    } else {
        parent.set(key, value);
    }
}

/// Sets the value at a dotted path below `root`. Missing maps are created.
void setAtPath(Value& root, std::string_view path, const std::string& fullPath, const Value& value, Merge merge) {
    if (path.ends_with('.')) throw UsageError(value.where, "'{}': a path must not end in a dot", fullPath);
    Value* parent = &root;
    std::string key = takeKey(root, path);
    for (; !path.empty(); key = takeKey(*parent, path)) {
        Value* child = parent->find(key);
        if (!child) {
            Value created = Value::map();
            created.where = value.where;
            child = &parent->set(key, created);
        }
        if (!child->isMap())
            throw UsageError(value.where, "{}: '{}' is {}, which has no keys{}", fullPath, key, child->text(),
                             child->isList()
                                 ? fmt::format("; give it as a whole: in a sweep write a list of lists, as in {}: "
                                               "[[...], [...]]",
                                               fullPath.substr(0, fullPath.size() - path.size() - 1))
                                 : "");
        parent = child;
    }
    setNested(*parent, key, value, merge);
}

/// An entry of the graph from a pass's name or a map with `pass`.
Value passEntry(const Value& value, const std::string& path) {
    if (value.isMap() && value.find("pass")) return value;
    if (!value.isScalar())
        throw UsageError(value.where,
                         "{}: expected a pass, which is its name or a map with 'pass', or a list of passes", path);
    Value entry = Value::map();
    entry.where = value.where;
    entry.set("pass", value);
    return entry;
}

/// Replaces a pass by another one or a chain, whose last pass gets the id, so that later passes find it.
void swapPass(Value& graph, size_t index, const Value& value, const std::string& path) {
    std::vector<Value> chain;
    if (value.isList())
        for (const Value& item : value.items) chain.push_back(passEntry(item, path));
    else
        chain.push_back(passEntry(value, path));
    if (chain.empty()) throw UsageError(value.where, "{}: a chain needs at least one pass", path);
    const std::string kept = passId(graph.items[index]);
    if (const Value* own = chain.back().find("id"); own && !(own->isScalar() && own->scalar == kept))
        throw UsageError(own->where, "{}: {} has the id '{}', which later passes read: leave out its own id{}", path,
                         chain.size() > 1 ? "the last pass of the chain" : "the pass", kept,
                         own->isScalar() ? fmt::format(", '{}'", own->scalar) : "");
    Value id = Value::fromScalar(kept);
    id.where = value.where;
    chain.back().set("id", id);
    graph.items[index] = std::move(chain.back());
    graph.items.insert(graph.items.begin() + ptrdiff_t(index), chain.begin(), chain.end() - 1);
}

void overridePass(Value& graph, size_t index, const std::string& subpath, const std::string& path, const Value& value,
                  Merge merge) {
    const bool isSwap = subpath.empty() && (merge == Merge::Replace || !value.isMap() || value.find("pass"));
    if (isSwap) {
        swapPass(graph, index, value, path);
    } else if (subpath.empty()) {
        mergeInto(graph.items[index], value, merge);
    } else {
        setAtPath(graph.items[index], subpath, path, value, merge);
    }
}

/// "; did you mean ..." with the first match of: the path with dots instead of other separators; the id of a
/// pass of that name; a parameter of a pass, written without its id or with an underscore instead of the dot;
/// a key of a block; the most similar candidate. @param word the path's first component.
std::string nearestPath(const Value& config, const std::string& path, const std::string& word,
                        const std::vector<std::string>& candidates) {
    std::string dotted = path;
    for (char& c : dotted)
        if (c == '/' || c == ':') c = '.';
    if (dotted != path && hasTarget(config, dotted)) return fmt::format("; did you mean '{}'?", dotted);
    const Value* graph = config.find("graph");
    for (const Value& entry : graph && graph->isList() ? graph->items : std::vector<Value>())
        if (const Value* pass = entry.find("pass"); pass && pass->isScalar() && pass->scalar == word)
            return fmt::format("; did you mean '{}', the id of that pass?", passId(entry));
    for (const Value& entry : graph && graph->isList() ? graph->items : std::vector<Value>())
        for (const auto& [key, value] : entry.members)
            if (word == key || word == passId(entry) + "_" + key)
                return fmt::format("; did you mean '{}.{}'?", passId(entry), key);
    if (const std::string path = pathOfKey(word); !path.empty()) return fmt::format("; did you mean '{}'?", path);
    return didYouMean(word, candidates);
}

/// Changes named values of an axis: null takes one out. @throws UsageError where there is none of that name.
void changeAxis(Value* axis, const std::string& path, const Value& changes) {
    for (const auto& [name, value] : changes.members) {
        std::vector<std::string> names;
        for (const auto& member : axis ? axis->members : std::vector<Value::Member>()) names.push_back(member.key);
        if (value.isNull() && std::ranges::count(names, name) == 0)
            throw UsageError(value.where, "sweep.{}: null takes a named value out, but there is no '{}'{}", path, name,
                             names.empty() ? "" : didYouMean(name, names));
        if (!axis)
            throw UsageError(value.where, "sweep.{}: null takes a named value out, but there is no such axis", path);
        setNested(*axis, name, value, Merge::Replace);
    }
}

/// The axis that has the rest of a path as the name of a value; null if none has. @param name gets it
Value* axisOfName(Value& sweep, const std::string& path, std::string& name) {
    for (auto& [axis, values] : sweep.members) {
        if (!values.isMap() || !path.starts_with(axis + ".")) continue;
        name = path.substr(axis.size() + 1);
        if (values.find(name)) return &values;
    }
    return nullptr;
}

/// @throws UsageError for an axis that is not there.
void removeAxis(Value& sweep, const std::string& path, const Value& null) {
    std::vector<std::string> known;
    for (const auto& [axis, values] : sweep.members) {
        known.push_back(axis);
        for (const auto& named : values.members) known.push_back(axis + "." + named.key);
    }
    if (!sweep.erase(path))
        throw UsageError(null.where,
                         "sweep.{}: null takes an axis or a named value out, but the sweep has none of that name{}",
                         path, didYouMean(path, known));
}

void overrideSweep(Value& config, const std::string& subpath, const Value& value) {
    if (subpath.empty()) {
        if (value.isNull())
            config.erase("sweep");
        else if (!value.isMap())
            throw UsageError(value.where, "sweep: expected a map of lists");
        for (const auto& [key, axis] : value.members) overrideSweep(config, key, axis);
        return;
    }
    Value* sweep = config.find("sweep");
    if (!sweep || !sweep->isMap()) {
        Value created = Value::map();
        created.where = value.where;
        sweep = &config.set("sweep", created);
    }
    const bool changesValues =
        std::ranges::any_of(value.members, [](const Value::Member& member) { return member.value.isNull(); });
    std::string name;
    if (changesValues)
        changeAxis(sweep->find(subpath), subpath, value);
    else if (Value* axis = sweep->find(subpath) ? nullptr : axisOfName(*sweep, subpath, name))
        setNested(*axis, name, value, Merge::Replace);
    else if (value.isNull())
        removeAxis(*sweep, subpath, value);
    else
        setNested(*sweep, subpath, value, Merge::Replace);
}

}  // namespace

const std::vector<std::string>& configKeys() {
    static const std::vector<std::string> keys{"name",  "scene",     "image", "seed",    "tracer",
                                               "graph", "reference", "sweep", "measure", "profiles"};
    return keys;
}

std::string optionFor(const std::string& key) {
    static const std::map<std::string, std::string> options{{"output", "--out DIR"},
                                                            {"out", "--out DIR"},
                                                            {"results", "--out DIR"},
                                                            {"device", "--device NAME"},
                                                            {"scenes", "--scenes DIR"}};
    const auto option = options.find(key);
    return option == options.end() ? "" : option->second;
}

bool hasTarget(const Value& config, const std::string& path) {
    const std::string first = path.substr(0, path.find('.'));
    if (std::ranges::count(configKeys(), first) > 0) return true;
    const Value* graph = config.find("graph");
    if (!graph || !graph->isList()) return false;
    return std::ranges::any_of(graph->items, [&](const Value& entry) { return passId(entry) == first; });
}

const Value* valueAt(const Value& config, const std::string& path) {
    const Value* found = &config;
    size_t from = 0;
    const std::string first = path.substr(0, path.find('.'));
    if (const Value* graph = config.find("graph")) {
        const auto pass = std::ranges::find(graph->items, first, passId);
        if (pass != graph->items.end()) {
            found = &*pass;
            from = first.size() + 1;
        }
    }
    std::string_view remaining = std::string_view(path).substr(std::min(from, path.size()));
    while (found && !remaining.empty()) found = found->find(takeKey(*found, remaining));
    return found;
}

TextLocation locationOf(const Value& config, const std::string& path) {
    const Value* found = &config;
    for (std::string_view remaining = path; !remaining.empty();) {
        const Value* next = found->find(takeKey(*found, remaining));
        if (!next) break;
        found = next;
    }
    return found->where;
}

std::string lastKey(const Value& config, const std::string& path) {
    const Value* parent = &config;
    std::string_view remaining = path;
    std::string key = takeKey(config, remaining);
    for (; !remaining.empty(); key = takeKey(parent ? *parent : Value(), remaining))
        if (parent) parent = parent->find(key);
    return key;
}

std::string passId(const Value& entry) {
    for (const char* key : {"id", "pass"})
        if (const Value* found = entry.find(key); found && found->isScalar()) return found->scalar;
    return {};
}

void applyOverride(Value& config, const std::string& path, const Value& value, Merge merge) {
    const size_t dot = path.find('.');
    const std::string first = path.substr(0, dot);
    const std::string subpath = dot == std::string::npos ? std::string() : path.substr(dot + 1);
    if (first == "sweep") return overrideSweep(config, subpath, value);
    if (first == "profiles") throw UsageError(value.where, "'{}': profiles can't be changed by an override", path);

    // The path of a pass or its parameter
    std::vector<std::string> candidates(configKeys());
    if (Value* graph = config.find("graph"); graph && graph->isList()) {
        for (size_t i = 0; i < graph->items.size(); ++i) {
            const std::string id = passId(graph->items[i]);
            if (id == first && !id.empty()) return overridePass(*graph, i, subpath, path, value, merge);
            if (!id.empty()) candidates.push_back(id);
        }
    }

    // The path of a config key
    if (std::ranges::count(configKeys(), first) == 0)
        throw UsageError(value.where, "'{}': neither a key of the config nor a pass of its graph{}", first,
                         optionFor(first).empty() ? nearestPath(config, path, first, candidates)
                                                  : "; it is said on the command line: " + optionFor(first));
    setAtPath(config, path, path, value, merge);
}

void applyProfile(Value& config, const std::string& name) {
    const Value* profiles = config.find("profiles");
    std::vector<std::string> names;
    if (profiles)
        for (const auto& member : profiles->members) names.push_back(member.key);
    const Value* profile = profiles ? profiles->find(name) : nullptr;
    if (!profile) {
        const TextLocation where = profiles ? profiles->where : TextLocation{config.where.file, 0};
        throw UsageError(where, "no profile '{}'{}", name,
                         names.empty() ? "; this config has none" : didYouMean(name, names));
    }
    if (!profile->isMap())
        throw UsageError(profile->where, "profiles.{}: expected a map of overrides, as in {{image.width: 160}}", name);
    const Value overrides = *profile;
    for (const auto& [path, value] : overrides.members) {
        for (const char* required : {"name", "scene", "graph"})
            if (path == required && value.isNull())
                throw UsageError(value.where, "profiles.{}: no config does without '{}'", name, path);
        applyOverride(config, path, value);
    }
}

void applyAssignment(Value& config, const std::string& assignment) {
    const std::string label = "--set " + assignment;
    const size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError("{}: expected path=value, as in image.width=320", label);
    Value value = parseYaml(assignment.substr(equals + 1), label);
    locate(value, {label});  // It has no line numbers
    applyOverride(config, assignment.substr(0, equals), value);
}

}  // namespace voxray
