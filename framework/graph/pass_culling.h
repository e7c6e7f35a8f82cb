#pragma once

#include <set>
#include <string>
#include <vector>

#include "graph/wiring.h"

namespace voxray {

/// Nodes and resources that the last writers of some ports depend on.
struct Needed {
    std::vector<bool> nodes;         ///< Whether each node is needed.
    std::set<const Resource*> read;  ///< What these nodes read, and what is read from outside.
};

/// Dependencies of the last writers of these ports. A node that writes nothing is always needed.
/// @param nodes in execution order.
Needed neededFor(const std::vector<GraphNode>& nodes, const std::vector<std::string>& portNames);

/// "graph.yaml:5: 'a' is never run: ...", with the reason and a remedy, for a pass that no compared image
/// depends on. @param nodes of the whole graph, in execution order.
std::string whyCulled(const std::vector<GraphNode>& nodes, const std::string& id);

}  // namespace voxray
