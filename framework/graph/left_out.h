#pragma once

#include <set>
#include <string>
#include <vector>

#include "graph/wiring.h"

namespace voxray {

/// What the last writers of some ports depend on.
struct Needed {
    std::vector<bool> nodes;         ///< By node.
    std::set<const Resource*> read;  ///< By these nodes, or from outside under the names of the ports.
};

/// Which nodes of a graph, in execution order, these ports depend on. One that writes nothing is always
/// needed.
Needed neededFor(const std::vector<GraphNode>& nodes, const std::vector<std::string>& portNames);

/// "graph.yaml:5: 'a' is never run: ...", with the reason and what to do, of a pass that no image that is
/// compared depends on.
/// @param nodes of the whole graph, in execution order.
std::string whyLeftOut(const std::vector<GraphNode>& nodes, const std::string& id);

}  // namespace voxray
