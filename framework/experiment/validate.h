#pragma once

#include <vector>

#include "config/sweep.h"
#include "graph/graph.h"
#include "graph/registry.h"

namespace voxray {

/// Expands the sweep and checks the graph of every variant and the reference's. Touches no device and no
/// scene.
/// @throws UsageError with file and line.
std::vector<Variant> validateExperiment(const Experiment& experiment, const Registry& registry);

/// A variant's graph without the passes that nothing of what is judged (`final`, `indirect`) depends on.
/// @param leftOut receives their ids.
Graph variantGraph(const Variant& variant, const Registry& registry,
                   std::vector<std::string>* leftOut = nullptr);

/// The reference as a graph of one pass.
Value referenceGraph(const Experiment& experiment);

}  // namespace voxray
