#pragma once

#include <string>
#include <vector>

#include "base/schema.h"
#include "config/sweep.h"
#include "graph/registry.h"

namespace voxray {

struct WiredExperiment;

/// A parameter in a variant's graph that has no effect there, since others in its pass leave it none.
struct IdlePath {
    std::string path;  ///< "<id>.<parameter>"
    IdleParameter parameter;
};

/// All of a variant's.
std::vector<IdlePath> idlePaths(const Variant& variant, const Registry& registry);

/// Refuses parameters that are written without effect. One that has an effect in some variants stays: a
/// sweep over the choice that it belongs to leaves it idle in the others.
/// @throws UsageError at the parameter's own place.
void checkIdleParameters(const WiredExperiment& wired);

}  // namespace voxray
