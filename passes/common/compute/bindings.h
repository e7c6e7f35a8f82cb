#pragma once

#include <vector>

#include "vulkan/commands.h"

namespace voxray {

/// What a dispatch binds, and more.
inline std::vector<Binding> joined(std::vector<Binding> bindings, const std::vector<Binding>& more) {
    bindings.insert(bindings.end(), more.begin(), more.end());
    return bindings;
}

}  // namespace voxray
