#pragma once

#include <vector>

#include "experiment/sweep.h"
#include "graph/registry.h"

namespace voxray {

/// Expands the sweep and checks the graph of every variant and the reference's. Touches no device and no
/// scene.
/// @throws UsageError with file and line.
std::vector<Variant> validateExperiment(const Experiment& experiment, const Registry& registry);

/// The reference as a graph of one pass.
Value referenceGraph(const Experiment& experiment);

}  // namespace voxray
