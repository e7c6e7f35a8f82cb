#include "graph/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace voxray {
namespace {

const GraphNode* lastWriter(const std::vector<GraphNode>& nodes, const std::string& port) {
    for (size_t n = nodes.size(); n-- > 0;)
        if (outputNamed(nodes[n], port)) return &nodes[n];
    return nullptr;
}

/// Nodes and resources that the last writers of some ports depend on.
struct Needed {
    std::vector<bool> nodes;         ///< Whether each node is needed.
    std::set<const Resource*> read;  ///< What these nodes read, and what is read from outside.
};

/// Dependencies of the last writers of these ports. A node that writes nothing is always needed.
/// @param nodes in execution order.
Needed neededFor(const std::vector<GraphNode>& nodes, const std::vector<std::string>& portNames) {
    // Backwards from the last writers: a node is needed if it writes nothing, or if a needed one reads it.
    Needed needed{std::vector<bool>(nodes.size()), {}};
    std::set<std::string> unresolved(portNames.begin(), portNames.end());
    for (size_t n = nodes.size(); n-- > 0;) {
        const GraphNode& node = nodes[n];
        bool isNeeded = std::ranges::none_of(node.ports, &PortInfo::output);
        for (size_t p = 0; p < node.ports.size(); ++p) {
            if (!node.ports[p].output) continue;
            if (unresolved.erase(node.ports[p].name) > 0) needed.read.insert(node.resources[p]);
            isNeeded |= needed.read.contains(node.resources[p]);
        }
        needed.nodes[n] = isNeeded;
        for (size_t p = 0; isNeeded && p < node.ports.size(); ++p)
            if (!node.ports[p].output) needed.read.insert(node.resources[p]);
    }
    return needed;
}

}  // namespace

uint64_t peakBytes(const std::vector<PassMemory>& passes) {
    uint64_t persistent = 0, scratch = 0;
    for (const PassMemory& pass : passes) {
        persistent += pass.bytes;
        scratch = std::max(scratch, pass.scratchBytes);
    }
    return persistent + scratch;
}

uint64_t estimatedBytes(const std::vector<PassMemory>& passes) {
    uint64_t bytes = 0;
    for (const PassMemory& pass : passes) bytes += pass.estimatedBytes;
    return bytes;
}

std::vector<Graph::PassInfo> Graph::passes() const {
    std::vector<PassInfo> infos;
    for (const GraphNode& node : nodes_)
        infos.push_back({node.id, node.kind, node.phase, node.pass->warmupFrames(), node.where, node.lightRays,
                         node.isReused, node.isSkipped});
    return infos;
}

void Graph::checkReadsLatest(const std::string& output, const std::string& input) const {
    const GraphNode *writer = lastWriter(nodes_, input), *reader = lastWriter(nodes_, output);
    if (!writer || !reader) return;
    const std::optional<size_t> port = inputNamed(*reader, input);
    const Value* inputs = reader->resolved.find("inputs");
    if (!port || (inputs && inputs->find(input))) return;
    if (reader->resources[*port] == writer->resources[*outputNamed(*writer, input)]) return;
    throw UsageError(writer->where,
                     "{0}: writes '{1}', but that is not what '{2}' reads, so '{3}' lacks what it brings: "
                     "put '{0}' right before '{2}', or choose with inputs of '{2}'",
                     writer->id, input, reader->id, output);
}

std::vector<Graph::Input> Graph::unboundInputs(const std::string& portName) const {
    std::vector<Input> inputs;
    const GraphNode* writer = lastWriter(nodes_, portName);
    for (size_t p = 0; writer && p < writer->ports.size(); ++p)
        if (!writer->ports[p].output && !writer->resources[p])
            inputs.push_back({writer->id, writer->ports[p].name, writer->where});
    return inputs;
}

std::string Graph::whyCulled(const std::string& id) const {
    const auto pass = std::ranges::find(nodes_, id, &GraphNode::id);
    std::string why = "no pass reads what it writes, and no image that is compared depends on it: leave it out";
    for (size_t p = pass->ports.size(); p-- > 0;) {
        const std::string& port = pass->ports[p].name;
        if (!pass->ports[p].output) continue;
        const auto isBound = [&](const GraphNode& node) {
            return std::ranges::count(node.resources, pass->resources[p]) > 0;
        };
        const auto reader = std::find_if(pass + 1, nodes_.end(), isBound);
        const auto laterWriter = std::find_if(
            pass + 1, nodes_.end(), [&](const GraphNode& node) { return outputNamed(node, port).has_value(); });
        if (reader != nodes_.end())
            why = fmt::format("'{}' reads it, but no image that is compared depends on that", reader->id);
        else if (laterWriter == nodes_.end())
            continue;
        else if (std::any_of(laterWriter + 1, nodes_.end(),
                             [&](const GraphNode& node) { return inputNamed(node, port).has_value(); }))
            why = fmt::format(
                "'{0}', after it, writes '{1}' too, and passes read the nearest: "
                "take one of the two out, or write 'inputs: {{{1}: {2}}}' in what shall read it",
                laterWriter->id, port, id);
        else
            why = fmt::format("'{}', after it, writes '{}' too, and the last one counts: take one of the two out",
                              laterWriter->id, port);
    }
    return UsageError(pass->where, "'{}' is never run: {}", id, why).what();
}

std::vector<std::string> Graph::cullUnused(const std::vector<std::string>& portNames) {
    const Needed needed = neededFor(nodes_, portNames);
    std::vector<GraphNode> neededNodes;
    std::vector<std::string> culled;
    for (size_t n = 0; n < nodes_.size(); ++n) {
        if (!needed.nodes[n]) {
            culled.push_back(nodes_[n].id);
            continue;
        }
        for (const std::unique_ptr<Resource>& output : nodes_[n].outputs)
            output->isRead = needed.read.contains(output.get());
        neededNodes.push_back(std::move(nodes_[n]));
    }
    nodes_ = std::move(neededNodes);
    return culled;
}

std::vector<std::string> Graph::noiseParameters(const std::string& portName) const {
    std::vector<std::string> paths;
    if (!writes(portName)) return paths;
    const Needed needed = neededFor(nodes_, {portName});
    for (size_t n = 0; n < nodes_.size(); ++n)
        if (needed.nodes[n])
            for (const std::string& name : nodes_[n].noiseParameters) paths.push_back(nodes_[n].id + "." + name);
    return paths;
}

std::vector<std::pair<std::string, std::vector<Aov>>> Graph::aovs() const {
    std::vector<std::pair<std::string, std::vector<Aov>>> byPass;
    for (const GraphNode& node : nodes_) {
        std::vector<Aov> aovs;
        for (const std::unique_ptr<Resource>& output : node.outputs)
            for (const Aov& aov : output->aovs())
                if (*aov.image) aovs.push_back(aov);  // Null where no pass reads it.
        if (!aovs.empty()) byPass.emplace_back(node.id, std::move(aovs));
    }
    return byPass;
}

Value Graph::resolved() const {
    Value list = Value::list();
    for (const GraphNode& node : nodes_) list.items.push_back(node.resolved);
    return list;
}

std::vector<UnusedSetting> Graph::unused() const {
    std::vector<UnusedSetting> parameters;
    for (const GraphNode& node : nodes_)
        for (const UnusedSetting& parameter : node.unused)
            parameters.push_back({node.id + "." + parameter.name, parameter.where, parameter.why});
    return parameters;
}

bool Graph::writes(const std::string& portName) const {
    return lastWriter(nodes_, portName);
}

const Resource* Graph::find(const std::string& portName, std::type_index type) const {
    const Resource* found = nullptr;
    for (const GraphNode& node : nodes_)
        if (const auto p = outputNamed(node, portName); p && node.ports[*p].type == type) found = node.resources[*p];
    return found;
}

}  // namespace voxray
