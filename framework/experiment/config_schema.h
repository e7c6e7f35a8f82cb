#pragma once

#include "base/value.h"
#include "graph/registry.h"

namespace voxray {

/// JSON Schema (draft 2020-12) of a config, for editors: every key with its type, range, default and help,
/// and the parameters of every pass. It is generated from the schemas by which configs are read. Dotted keys
/// of profiles and sweeps are unrestricted.
Value configJsonSchema(const Registry& registry);

}  // namespace voxray
