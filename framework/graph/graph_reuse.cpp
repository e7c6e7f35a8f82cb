#include <algorithm>
#include <map>

#include "graph/graph.h"

namespace voxray {
namespace {

/// Whether a build pass that has run would write the same outputs as one that has not.
/// @param node its inputs that are outputs of reused passes are bound to these.
bool wouldWriteTheSame(const GraphNode& node, const GraphNode& previous, bool sameView) {
    const auto sameReaders = [](const auto& a, const auto& b) { return a->isRead == b->isRead; };
    if (node.phase != Phase::Build || !previous.pass || !previous.seenVersions) return false;
    if (!sameView && node.pass->buildReadsView()) return false;
    if (node.id != previous.id || node.phase != previous.phase || !(node.resolved == previous.resolved)) return false;
    if (!std::ranges::equal(node.outputs, previous.outputs, sameReaders)) return false;
    for (size_t p = 0; p < node.ports.size(); ++p)
        if (!node.ports[p].output && node.resources[p] != previous.resources[p]) return false;
    return true;
}

}  // namespace

void Graph::reuse(Graph& previous, bool sameView) {
    std::map<const Resource*, Resource*> reused;  // By output of this graph's own node: the one that takes its place.
    for (GraphNode& node : nodes_) {
        for (Resource*& resource : node.resources)
            if (const auto found = reused.find(resource); found != reused.end()) resource = found->second;
        const auto found = std::ranges::find_if(
            previous.nodes_, [&](const GraphNode& other) { return wouldWriteTheSame(node, other, sameView); });
        if (found == previous.nodes_.end()) {
            for (const auto& output : node.outputs)
                if (const auto index = reused.find(output->indexResource); index != reused.end())
                    output->indexResource = index->second;
            continue;
        }
        for (size_t o = 0; o < node.outputs.size(); ++o) reused.emplace(node.outputs[o].get(), found->outputs[o].get());
        found->where = node.where;
        node = std::move(*found);
        node.isReused = true;
    }
}

}  // namespace voxray
