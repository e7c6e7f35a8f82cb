#pragma once

namespace voxray {

struct WiredExperiment;

/// Refuses parameters that are written without effect. One that has an effect in some variants stays: a
/// sweep over the choice that it belongs to leaves it idle in the others.
/// @throws UsageError at the parameter's own place.
void checkIdleParameters(const WiredExperiment& wired);

}  // namespace voxray
