#include "graph/wiring.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

#include "base/suggest.h"
#include "graph/index_resource.h"

namespace voxray {
namespace {

/// A node and one of its output ports.
struct Source {
    size_t node;
    size_t port;
};

std::optional<size_t> portNamed(const GraphNode& node, const std::string& name, bool isOutput) {
    for (size_t p = 0; p < node.ports.size(); ++p)
        if (node.ports[p].output == isOutput && node.ports[p].name == name) return p;
    return {};
}

std::vector<std::string> idsOf(const std::vector<GraphNode>& nodes) {
    std::vector<std::string> ids;
    for (const GraphNode& node : nodes) ids.push_back(node.id);
    return ids;
}

/// @throws UsageError for an unknown parameter that another pass of the graph has.
void checkParameters(const Registry& registry, const PassKind& kind, const Value& entry, const std::string& id,
                     const Value& passList) {
    const auto has = [](const PassKind& k, const std::string& name) {
        return std::ranges::count(k.parameters, name, &ParameterDoc::name) > 0;
    };
    for (const auto& [key, value] : entry.members) {
        if (has(kind, key) || std::ranges::count(reservedKeys(), key) > 0) continue;
        for (const Value& otherEntry : passList.items) {
            const Value* name = otherEntry.find("pass");
            const PassKind* otherKind = name && name->isScalar() ? registry.find(name->scalar) : nullptr;
            if (!otherKind || !has(*otherKind, key)) continue;
            std::vector<std::string> names;
            for (const ParameterDoc& doc : kind.parameters) names.push_back(doc.name);
            throw UsageError(value.where, "{}: unknown parameter '{}', which '{}' has; one of: {}", id, key,
                             otherKind->name, names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
        }
    }
}

/// @param passList the graph of the entry.
GraphNode readNode(const Registry& registry, const Value& entry, const Value& passList) {
    if (!entry.isMap())
        throw UsageError(entry.where, "graph: each entry is a map with a 'pass', e.g. {{pass: gbuffer}}");
    const Value* passName = entry.find("pass");
    if (!passName) {
        std::string hint;
        if (!entry.members.empty()) hint = didYouMean(entry.members.front().key, reservedKeys());
        throw UsageError(entry.where, "graph: entry without 'pass'{}", hint);
    }
    GraphNode node;
    const PassKind& kind = registry.require(passName->asString("graph.pass"), passName->where);
    const Value* id = entry.find("id");
    node.id = id ? id->asString("graph.id") : kind.name;
    node.where = entry.where;
    node.kind = kind.name;
    checkParameters(registry, kind, entry, node.id, passList);
    ConfiguredPass configured = kind.create(entry, node.id);
    node.pass = std::move(configured.pass);
    node.ports = node.pass->ports();
    for (const ParameterDoc& doc : kind.parameters) {
        if (std::ranges::count(configured.unused, doc.name, &UnusedSetting::name) > 0) continue;
        if (doc.type == "integer" && configured.parameters.find(doc.name)->scalar != doc.min)
            node.sizeParameters.push_back(doc.name);
        if (doc.isLessNoise) node.noiseParameters.push_back(doc.name);
    }
    for (UnusedSetting& parameter : configured.unused)
        if (const Value* written = entry.find(parameter.name)) {
            parameter.where = written->where;
            node.unused.push_back(std::move(parameter));
        }

    // Resolved: the reserved keys as written, then all parameters.
    node.resolved = Value::map();
    for (const std::string& key : reservedKeys())
        if (const Value* value = entry.find(key)) node.resolved.set(key, *value);
    for (auto& [key, value] : configured.parameters.members) node.resolved.set(key, std::move(value));
    return node;
}

/// The source that the config's `inputs` names for a port: "id" or "id.port".
Source explicitSource(const std::vector<GraphNode>& nodes, const GraphNode& reader, const PortInfo& port,
                      const Value& reference) {
    const std::string text = reference.asString(reader.id + ".inputs." + port.name);
    const size_t dot = text.find('.');
    const std::string id = text.substr(0, dot);
    const std::string portName = dot == std::string::npos ? port.name : text.substr(dot + 1);
    for (size_t n = 0; n < nodes.size(); ++n) {
        if (nodes[n].id != id) continue;
        if (const auto output = outputNamed(nodes[n], portName)) return {n, *output};
        std::vector<std::string> outputs;
        for (const PortInfo& p : nodes[n].ports)
            if (p.output) outputs.push_back(p.name);
        throw UsageError(reference.where, "{}.inputs.{}: '{}' writes no '{}'{}", reader.id, port.name, id, portName,
                         didYouMean(portName, outputs));
    }
    throw UsageError(reference.where, "{}.inputs.{}: no pass has the id '{}'{}", reader.id, port.name, id,
                     didYouMean(id, idsOf(nodes)));
}

/// The nearest earlier pass that writes a port of this name, or nothing for an optional port.
/// @param position of the reader in the list, which it need not be in.
std::optional<Source> implicitSource(const std::vector<GraphNode>& nodes, size_t position, const GraphNode& reader,
                                     const PortInfo& port, const Registry& registry) {
    for (size_t n = position; n-- > 0;)
        if (const auto output = outputNamed(nodes[n], port.name)) return Source{n, *output};
    if (port.optional) return {};
    for (size_t n = position + 1; n < nodes.size(); ++n)
        if (outputNamed(nodes[n], port.name))
            throw UsageError(reader.where, "{}: reads '{}', which '{}' writes only later; move '{}' up", reader.id,
                             port.name, nodes[n].id, nodes[n].id);
    const std::vector<std::string> writers = registry.writersOf(port.name);
    throw UsageError(reader.where, "{}: missing port '{}' ({}); no pass before it writes it{}", reader.id, port.name,
                     port.help, writers.empty() ? "" : fmt::format("; these can: {}", fmt::join(writers, ", ")));
}

/// ", as in {irradiance: inject}" for `inputs` that are no map, with the pass that they name, if any.
std::string exampleOfInputs(const std::vector<GraphNode>& nodes, const std::vector<std::string>& ports,
                            const Value& inputs) {
    const Value& named = inputs.items.empty() ? inputs : inputs.items[0];
    for (const GraphNode& writer : nodes)
        for (const std::string& port : ports)
            if (named.isScalar() && writer.id == named.scalar && outputNamed(writer, port))
                return fmt::format(", as in {{{}: {}}}", port, writer.id);
    return ports.empty() ? "" : fmt::format(", as in {{{}: ID}}", ports[0]);
}

void checkInputKeys(const std::vector<GraphNode>& nodes, const GraphNode& node, const Value& inputs) {
    std::vector<std::string> names;
    for (const PortInfo& port : node.ports)
        if (!port.output) names.push_back(port.name);
    if (!inputs.isMap())
        throw UsageError(inputs.where, "{}.inputs: expected a map of ports and ids{}; its ports are {}", node.id,
                         exampleOfInputs(nodes, names, inputs), fmt::join(names, ", "));
    for (const auto& [key, value] : inputs.members)
        if (std::find(names.begin(), names.end(), key) == names.end())
            throw UsageError(value.where, "{}.inputs: '{}' is not an input of {}{}", node.id, key, node.kind,
                             didYouMean(key, names));
}

/// Topological order: writers before readers, ties in the list's order. @throws UsageError naming the passes
/// of a cycle.
std::vector<size_t> topologicalOrder(const std::vector<GraphNode>& nodes,
                                     const std::vector<std::set<size_t>>& dependencies) {
    std::vector<size_t> order;
    std::set<size_t> done;
    while (order.size() < nodes.size()) {
        const size_t before = order.size();
        for (size_t n = 0; n < nodes.size(); ++n) {
            if (done.count(n)) continue;
            const bool ready = std::all_of(dependencies[n].begin(), dependencies[n].end(),
                                           [&](size_t d) { return done.count(d) > 0; });
            if (!ready) continue;
            order.push_back(n);
            done.insert(n);
            break;
        }
        if (order.size() > before) continue;
        std::string names;
        TextLocation where;
        for (size_t n = 0; n < nodes.size(); ++n) {
            if (done.count(n)) continue;
            if (names.empty()) where = nodes[n].where;
            names += (names.empty() ? "" : ", ") + nodes[n].id;
        }
        throw UsageError(where, "graph: cycle between {}; change their 'inputs'", names);
    }
    return order;
}

}  // namespace

std::optional<size_t> inputNamed(const GraphNode& node, const std::string& name) {
    return portNamed(node, name, false);
}

std::optional<size_t> outputNamed(const GraphNode& node, const std::string& name) {
    return portNamed(node, name, true);
}

void checkEntry(const Registry& registry, const Value& entry) {
    const GraphNode node = readNode(registry, entry, {});
    if (const Value* inputs = entry.find("inputs")) checkInputKeys({}, node, *inputs);
}

std::vector<GraphNode> wireGraph(const Registry& registry, const Value& passList) {
    if (!passList.isList() || passList.items.empty())
        throw UsageError(passList.where, "graph: expected a list of passes, e.g. [{{pass: gbuffer}}, ...]");

    // Read every pass; ids are unique.
    std::vector<GraphNode> nodes;
    for (const Value& entry : passList.items) {
        nodes.push_back(readNode(registry, entry, passList));
        for (size_t n = 0; n + 1 < nodes.size(); ++n)
            if (nodes[n].id == nodes.back().id)
                throw UsageError(entry.where, "graph: two passes have the id '{}'; give one another 'id'", nodes[n].id);
    }

    // A pass owns its outputs. Only the last output of a name can be read from outside the graph.
    std::set<std::string> laterOutputs;
    for (size_t n = nodes.size(); n-- > 0;) {
        GraphNode& node = nodes[n];
        node.resources.assign(node.ports.size(), nullptr);
        for (size_t p = 0; p < node.ports.size(); ++p) {
            if (!node.ports[p].output) continue;
            node.outputs.emplace_back(node.ports[p].create());
            node.resources[p] = node.outputs.back().get();
            node.resources[p]->isRead = laterOutputs.insert(node.ports[p].name).second;
        }
    }

    // Bind all inputs and collect dependencies.
    std::vector<std::set<size_t>> dependencies(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n) {
        const Value* inputs = passList.items[n].find("inputs");
        if (inputs) checkInputKeys(nodes, nodes[n], *inputs);
        for (size_t p = 0; p < nodes[n].ports.size(); ++p) {
            const PortInfo& port = nodes[n].ports[p];
            if (port.output) continue;
            const Value* reference = inputs ? inputs->find(port.name) : nullptr;
            const std::optional<Source> source = reference ? explicitSource(nodes, nodes[n], port, *reference)
                                                           : implicitSource(nodes, n, nodes[n], port, registry);
            if (!source) continue;
            const GraphNode& writer = nodes[source->node];
            if (!port.accepts(*writer.resources[source->port]))
                throw UsageError(nodes[n].where, "{}: port '{}' can't read '{}.{}', which is of another type",
                                 nodes[n].id, port.name, writer.id, writer.ports[source->port].name);
            nodes[n].resources[p] = writer.resources[source->port];
            writer.resources[source->port]->isRead = true;
            dependencies[n].insert(source->node);
        }
    }

    // Readers of frame passes are frame passes.
    const std::vector<size_t> order = topologicalOrder(nodes, dependencies);
    for (const size_t n : order) {
        const bool readsFrame =
            std::ranges::any_of(dependencies[n], [&](size_t writer) { return nodes[writer].phase == Phase::Frame; });
        nodes[n].phase = readsFrame ? Phase::Frame : nodes[n].pass->phase();
    }

    std::vector<GraphNode> ordered;
    for (const size_t n : order) ordered.push_back(std::move(nodes[n]));
    bindIndexResources(ordered);
    return ordered;
}

GraphNode wireLast(const Registry& registry, const std::vector<GraphNode>& nodes, const Value& entry) {
    GraphNode node = readNode(registry, entry, Value::list());
    for (const GraphNode& other : nodes)
        if (other.id == node.id) throw UsageError(entry.where, "graph: there is a pass '{}' already", node.id);
    const Value* inputs = entry.find("inputs");
    if (inputs) checkInputKeys(nodes, node, *inputs);
    for (const PortInfo& port : node.ports) {
        if (port.output) {
            node.outputs.emplace_back(port.create());
            node.resources.push_back(node.outputs.back().get());
            continue;
        }
        const Value* reference = inputs ? inputs->find(port.name) : nullptr;
        const std::optional<Source> source = reference ? explicitSource(nodes, node, port, *reference)
                                                       : implicitSource(nodes, nodes.size(), node, port, registry);
        Resource* resource = source ? nodes[source->node].resources[source->port] : nullptr;
        if (resource && !port.accepts(*resource))
            throw UsageError(node.where, "{}: port '{}' can't read that of '{}', which is of another type", node.id,
                             port.name, nodes[source->node].id);
        if (resource && !resource->isRead)
            throw UsageError(node.where, "{}: '{}' of '{}' is empty, since no pass of the config reads it", node.id,
                             port.name, nodes[source->node].id);
        node.resources.push_back(resource);
    }
    node.phase = Phase::Frame;
    return node;
}

}  // namespace voxray
