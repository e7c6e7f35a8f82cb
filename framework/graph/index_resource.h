#pragma once

#include <vector>

#include "graph/wiring.h"

namespace voxray {

/// Sets Resource::indexResource of all resources. @param nodes in execution order, with bound ports.
/// @throws UsageError where a pass reads a resource together with another one than that which indexes it.
void bindIndexResources(const std::vector<GraphNode>& nodes);

}  // namespace voxray
