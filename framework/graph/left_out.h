#pragma once

#include <string>
#include <vector>

#include "graph/wiring.h"

namespace voxray {

/// "graph.yaml:5: 'a' is never run: ...", with the reason and what to do, of a pass that no image that is
/// compared depends on.
/// @param nodes of the whole graph, in execution order.
std::string whyLeftOut(const std::vector<GraphNode>& nodes, const std::string& id);

}  // namespace voxray
