#include "graph/graph.h"

#include <algorithm>

#include "graph/pass_culling.h"

namespace voxray {

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
        infos.push_back(
            {node.id, node.kind, node.phase, node.pass->warmupFrames(), node.where, node.lightRays});
    return infos;
}

void Graph::checkReadsLast(const std::string& output, const std::string& input) const {
    const GraphNode *lastWriter = nullptr, *reader = nullptr;
    const Resource *lastWritten = nullptr, *read = nullptr;
    bool reads = false;
    for (const GraphNode& node : nodes_)
        for (size_t p = 0; p < node.ports.size(); ++p) {
            if (!node.ports[p].output) continue;
            if (node.ports[p].name == input) lastWriter = &node, lastWritten = node.resources[p];
            if (node.ports[p].name == output) reader = &node;
        }
    if (!lastWriter || !reader) return;
    for (size_t p = 0; p < reader->ports.size(); ++p)
        if (!reader->ports[p].output && reader->ports[p].name == input) {
            reads = true;
            read = reader->resources[p];
        }
    const Value* inputs = reader->resolved.find("inputs");
    if (!reads || read == lastWritten || (inputs && inputs->find(input))) return;
    throw UsageError(
        lastWriter->where,
        "{0}: writes '{1}', but that is not what '{2}' reads, so '{3}' lacks what it brings: put '{0}' "
        "right before '{2}', or choose with inputs of '{2}'",
        lastWriter->id, input, reader->id, output);
}

std::vector<Graph::Input> Graph::unboundInputs(const std::string& portName) const {
    const auto isWriter = [&](const GraphNode& node) { return outputNamed(node, portName).has_value(); };
    const auto last = std::find_if(nodes_.rbegin(), nodes_.rend(), isWriter);
    std::vector<Input> inputs;
    for (size_t p = 0; last != nodes_.rend() && p < last->ports.size(); ++p)
        if (!last->ports[p].output && !last->resources[p])
            inputs.push_back({last->id, last->ports[p].name, last->where});
    return inputs;
}

std::string Graph::whyCulled(const std::string& id) const {
    return voxray::whyCulled(nodes_, id);
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
            for (const std::string& name : nodes_[n].noiseParameters)
                paths.push_back(nodes_[n].id + "." + name);
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
    return std::ranges::any_of(
        nodes_, [&](const GraphNode& node) { return outputNamed(node, portName).has_value(); });
}

const Resource* Graph::find(const std::string& portName, std::type_index type) const {
    const Resource* found = nullptr;
    for (const GraphNode& node : nodes_)
        if (const auto p = outputNamed(node, portName); p && node.ports[*p].type == type)
            found = node.resources[*p];
    return found;
}

}  // namespace voxray
