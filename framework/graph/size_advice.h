#pragma once

#include <string>
#include <vector>

#include "graph/wiring.h"

namespace voxray {

/// Advice for a pass that takes too much memory: its integer parameters and those of the passes that it
/// reads, unless without effect or at their minimum, and the image's size.
std::string sizeAdvice(const std::vector<GraphNode>& nodes, const GraphNode& node);

}  // namespace voxray
