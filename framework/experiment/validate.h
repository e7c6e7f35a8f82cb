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
    /// By image ("final", "indirect"): what lowers its noise (Graph::noiseParameters()).
    std::map<std::string, std::vector<std::string>> noiseParameters;
    std::vector<IdleParameter> idle;  ///< What is written in the graph without effect: "<id>.<parameter>".
};

/// An experiment whose graphs are known to be right.
struct WiredExperiment {
    Experiment experiment;
    std::vector<WiredVariant> variants;
    Value reference;  ///< The reference's graph with every default filled in; null where there is none.
    /// Ids of passes that run in variants which the command line left out: no mistake of the config.
    std::vector<std::string> deselected;
};

/// Expands the sweep and wires the graph of every variant, once, and the reference's. Touches no device and
/// no scene.
/// @throws UsageError with file and line; also for a value of a sweep whose pass runs in no variant, while
/// another value's does, and for a pass whose `final` is written over by one that needs none of the
/// passes before it.
WiredExperiment wireExperiment(Experiment experiment, const Registry& registry);

/// Passes that no image of a variant depends on, by id: in how many variants that is so.
std::map<std::string, size_t> variantsWithout(const WiredExperiment& wired);

/// Whether any variant runs the pass of this id.
bool runsSomewhere(const WiredExperiment& wired, const std::string& id);

/// A pass that runs in no variant and writes `final`, which a later one writes too; "" where there is none.
std::string overwrittenFinal(const WiredExperiment& wired, const Registry& registry);

/// Why a pass runs in no variant, with file and line, and what to do (Graph::whyLeftOut()).
std::string whyNeverRun(const WiredExperiment& wired, const std::string& id, const Registry& registry);

/// A variant's graph, wired for one more rendering of it: without passes that nothing of what is compared
/// depends on.
Graph variantGraph(const Variant& variant, const Registry& registry);

/// The reference as a graph of one pass, for one rendering of it.
Graph referenceGraph(const Experiment& experiment, const Registry& registry);

}  // namespace voxray
