#pragma once

#include <string>
#include <vector>

#include "graph/wiring.h"

namespace voxray {

/// What to lower where a pass takes too much memory: its own whole-number parameters, those of the passes
/// that it reads, as far as they have an effect and are not at their least, and the image's size. Its buffers
/// and images grow with one of them or more.
std::string sizeAdvice(const std::vector<GraphNode>& nodes, const GraphNode& node);

}  // namespace voxray
