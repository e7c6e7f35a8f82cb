#pragma once

#include "graph/registry.h"

namespace voxray {

/// Adds every technique under passes/, and the path tracer as the registry's preview. A new pass is one line
/// here.
void registerPasses(Registry& registry);

}  // namespace voxray
