#include "graph/registry.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/suggest.h"

namespace voxray {
namespace {

/// Passes by the file that registers them. Static, since linking a pass is all that adds it.
std::multimap<std::string, PassRegistration::Add>& registrations() {
    static std::multimap<std::string, PassRegistration::Add> all;
    return all;
}

bool contains(const std::vector<PortInfo>& ports, const PortInfo& port) {
    return std::ranges::any_of(
        ports, [&](const PortInfo& other) { return other.name == port.name && other.output == port.output; });
}

std::vector<PortInfo> declared(const PassType& type, const void* params) {
    return type.make(params)->ports();
}

/// Ports with each value of one parameter.
struct PortsByValue {
    std::string parameter;
    std::vector<std::string> values;
    std::vector<std::vector<PortInfo>> ports;  ///< One list per value.
};

std::vector<PortsByValue> portsByChoice(const PassType& type) {
    std::vector<PortsByValue> choices;
    for (const Parameter& parameter : *type.schema) {
        PortsByValue choice{parameter.name, parameter.type->choices(), {}};
        if (std::string_view(parameter.type->name()) != "choice") continue;
        for (const std::string& value : choice.values) {
            const PassType::Params params = type.defaults();
            parameter.type->read(parameter.of(params.get()), Value::fromScalar(value), parameter.name);
            choice.ports.push_back(declared(type, params.get()));
        }
        choices.push_back(std::move(choice));
    }
    return choices;
}

/// All of a pass's ports: those of its defaults, then those that values of one parameter ask for.
std::vector<PortDoc> portsOf(const PassType& type) {
    const std::vector<PortsByValue> choices = portsByChoice(type);
    std::vector<PortInfo> all = declared(type, type.defaults().get());
    for (const PortsByValue& choice : choices)
        for (const std::vector<PortInfo>& ports : choice.ports)
            for (const PortInfo& port : ports)
                if (!contains(all, port)) all.push_back(port);

    // A parameter matters to a port that only some of its values have.
    std::vector<PortDoc> docs;
    for (const PortInfo& port : all) {
        PortDoc& doc = docs.emplace_back(PortDoc{port, {}});
        for (const PortsByValue& choice : choices) {
            std::vector<std::string> having;
            for (size_t v = 0; v < choice.values.size(); ++v)
                if (contains(choice.ports[v], port)) having.push_back(choice.values[v]);
            if (having.empty() || having.size() == choice.values.size()) continue;
            doc.with +=
                fmt::format("{}{}: {}", doc.with.empty() ? "" : ", or ", choice.parameter, fmt::join(having, " | "));
        }
    }
    return docs;
}

}  // namespace

const std::vector<std::string>& reservedKeys() {
    static const std::vector<std::string> keys{"pass", "id", "inputs"};
    return keys;
}

ConfiguredPass PassKind::create(const Value& map, const std::string& id) const {
    const PassType::Params params = type.defaults();
    readParams(*type.schema, params.get(), map, id, reservedKeys());
    Value parameters = writeParams(*type.schema, params.get());
    std::vector<UnusedSetting> unused = unusedSettings(*type.schema, params.get(), parameters);
    return {type.make(params.get()), std::move(parameters), std::move(unused)};
}

PassRegistration::PassRegistration(const char* file, Add add) {
    registrations().emplace(file, add);
}

size_t addRegistered(Registry& registry, std::string_view folder, const std::string& family) {
    size_t count = 0;
    for (const auto& [file, add] : registrations())
        if (file.find(folder) != std::string::npos) add(registry, family), ++count;
    return count;
}

void Registry::add(PassKind kind) {
    if (find(kind.name)) throw Error("two passes are called '{}': give one another kName", kind.name);
    kind.parameters = describeParams(*kind.type.schema, kind.type.defaults().get());
    kind.ports = portsOf(kind.type);
    kinds_.push_back(std::move(kind));
}

void Registry::renamed(std::string oldName, std::string advice) {
    renamed_.emplace(std::move(oldName), std::move(advice));
}

const PassKind* Registry::find(const std::string& name) const {
    for (const PassKind& kind : kinds_)
        if (kind.name == name) return &kind;
    return nullptr;
}

std::vector<std::string> Registry::writersOf(const std::string& port) const {
    std::vector<std::string> writers;
    for (const PassKind& kind : kinds_) {
        const auto has = [&](bool output) {
            return std::ranges::any_of(
                kind.ports, [&](const PortDoc& p) { return p.name == port && p.output == output && !p.optional; });
        };
        if (has(true) && !has(false)) writers.push_back(kind.name);
    }
    return writers;
}

std::map<std::string, std::string> Registry::filterLabels() const {
    std::map<std::string, std::string> labels;
    for (const PassKind& kind : kinds_)
        if (!kind.filterLabel.empty()) labels.emplace(kind.name, kind.filterLabel);
    return labels;
}

const PassKind& Registry::require(const std::string& name, const TextLocation& where) const {
    if (const PassKind* kind = find(name)) return *kind;
    if (const auto old = renamed_.find(name); old != renamed_.end())
        throw UsageError(where, "'{}' is now {}", name, old->second);
    std::vector<std::string> names;
    for (const PassKind& kind : kinds_) names.push_back(kind.name);
    throw UsageError(where, "unknown pass '{}'{}", name, didYouMean(name, names));
}

}  // namespace voxray
