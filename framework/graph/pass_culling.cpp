#include "graph/pass_culling.h"

#include <fmt/format.h>

#include <algorithm>

namespace voxray {
namespace {

bool writes(const GraphNode& node, const std::string& port) {
    return outputNamed(node, port).has_value();
}

bool reads(const GraphNode& node, const std::string& port) {
    return std::ranges::any_of(node.ports,
                               [&](const PortInfo& input) { return !input.output && input.name == port; });
}

}  // namespace

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

std::string whyCulled(const std::vector<GraphNode>& nodes, const std::string& id) {
    const auto pass = std::ranges::find(nodes, id, &GraphNode::id);
    std::string why =
        "no pass reads what it writes, and no image that is compared depends on it: leave it out";
    for (size_t p = pass->ports.size(); p-- > 0;) {
        const std::string& port = pass->ports[p].name;
        if (!pass->ports[p].output) continue;
        const auto isBound = [&](const GraphNode& node) {
            return std::ranges::count(node.resources, pass->resources[p]) > 0;
        };
        const auto reader = std::find_if(pass + 1, nodes.end(), isBound);
        const auto laterWriter =
            std::find_if(pass + 1, nodes.end(), [&](const GraphNode& node) { return writes(node, port); });
        if (reader != nodes.end())
            why = fmt::format("'{}' reads it, but no image that is compared depends on that", reader->id);
        else if (laterWriter == nodes.end())
            continue;
        else if (std::any_of(laterWriter + 1, nodes.end(),
                             [&](const GraphNode& node) { return reads(node, port); }))
            why = fmt::format(
                "'{0}', after it, writes '{1}' too, and passes read the nearest: "
                "take one of the two out, or write 'inputs: {{{1}: {2}}}' in what shall read it",
                laterWriter->id, port, id);
        else
            why = fmt::format(
                "'{}', after it, writes '{}' too, and the last one counts: take one of the two out",
                laterWriter->id, port);
    }
    return UsageError(pass->where, "'{}' is never run: {}", id, why).what();
}

}  // namespace voxray
