#pragma once

#include "base/value.h"
#include "graph/registry.h"

namespace voxray {

/// JSON Schema (draft 2020-12) of a config, for editors: every key, its type, range, default and help, and
/// the parameters of every pass. Made from the same schemas that read the config. Dotted keys of profiles and
/// sweeps are left open.
Value configJsonSchema(const Registry& registry);

}  // namespace voxray
