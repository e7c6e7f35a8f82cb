#pragma once

#include <map>
#include <string>
#include <vector>

#include "config/sweep.h"
#include "experiment/idle_parameters.h"
#include "graph/graph.h"
#include "graph/registry.h"

namespace voxray {

/// A variant with its graph, for one run of it.
struct WiredVariant : Variant {
    Graph graph;     ///< Without passes that nothing of what is compared (`final`, `indirect`) depends on.
    Value resolved;  ///< The graph with every default filled in.
    std::vector<std::string> leftOut;  ///< Ids of the passes that the graph does without.
    std::vector<IdlePath> idle;        ///< What is written in the graph without effect.
};

/// An experiment whose graphs are known to be right.
struct WiredExperiment {
    Experiment experiment;
    std::vector<WiredVariant> variants;
    Value reference;  ///< The reference's graph with every default filled in; null where there is none.
};

/// Expands the sweep and wires the graph of every variant, once, and the reference's. Touches no device and
/// no scene.
/// @throws UsageError with file and line; also for a value of a sweep whose pass runs in no variant, while
/// another value's does.
WiredExperiment wireExperiment(Experiment experiment, const Registry& registry);

/// Passes that no image of a variant depends on, by id: in how many variants that is so.
std::map<std::string, size_t> variantsWithout(const WiredExperiment& wired);

/// Whether any variant runs the pass of this id.
bool runsSomewhere(const WiredExperiment& wired, const std::string& id);

/// A variant's graph, wired for one more rendering of it: without passes that nothing of what is compared
/// depends on.
Graph variantGraph(const Variant& variant, const Registry& registry);

/// The reference as a graph of one pass, for one rendering of it.
Graph referenceGraph(const Experiment& experiment, const Registry& registry);

}  // namespace voxray
