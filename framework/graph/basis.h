#pragma once

#include <vector>

#include "graph/wiring.h"

namespace voxray {

/// Tells each resource what its elements are numbered by (Resource::basis). Nodes stand in the order in which
/// they run, and are bound.
/// @throws UsageError where a pass reads a resource together with another basis than that one's.
void bindBases(const std::vector<GraphNode>& nodes);

}  // namespace voxray
