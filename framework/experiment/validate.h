#pragma once

#include <vector>

#include "config/sweep.h"
#include "graph/graph.h"
#include "graph/registry.h"

namespace voxray {

/// A variant with its graph, for one run of it.
struct WiredVariant : Variant {
    Graph graph;     ///< Without passes that nothing of what is compared (`final`, `indirect`) depends on.
    Value resolved;  ///< The graph with every default filled in.
    std::vector<std::string> leftOut;  ///< Ids of the passes that the graph does without.
};

/// An experiment whose graphs are known to be right.
struct WiredExperiment {
    Experiment experiment;
    std::vector<WiredVariant> variants;
    Value reference;  ///< The reference's graph with every default filled in; null where there is none.
};

/// Expands the sweep and wires the graph of every variant, once, and the reference's. Touches no device and
/// no scene.
/// @throws UsageError with file and line.
WiredExperiment wireExperiment(Experiment experiment, const Registry& registry);

/// The reference as a graph of one pass, for one rendering of it.
Graph referenceGraph(const Experiment& experiment, const Registry& registry);

}  // namespace voxray
