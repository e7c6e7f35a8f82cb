#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/sweep.h"
#include "experiment/pixel_masks.h"
#include "experiment/results.h"
#include "graph/graph.h"
#include "graph/registry.h"

namespace voxray {

/// The port whose image is compared with the reference, and that of the indirect light in it.
inline constexpr const char* kComparedImage = "final";
inline constexpr const char* kIndirectImage = "indirect";
/// The ports of which the compared image is made.
inline constexpr const char* kPartsOfLight[] = {"direct", kIndirectImage};

/// A point of the sweep, filled in on its way: wired, planned, run.
struct Variant : SweepPoint {
    /// Wires its graph. @throws UsageError with file and line.
    Variant(SweepPoint point, const Registry& registry);

    Graph graph;     ///< Without passes that nothing of what is compared depends on; for one run of it.
    Value resolved;  ///< The graph with every default filled in.
    std::vector<std::string> leftOut;  ///< Ids of the passes that the graph does without.
    /// By port of what is compared: what lowers its noise (Graph::noiseParameters()).
    std::map<std::string, std::vector<std::string>> noiseParameters;
    std::vector<UnusedSetting> unused;  ///< What is written in the graph without effect: "<id>.<parameter>".

    // From planVariants() on
    std::string sceneKey;            ///< SceneLoader::key() of its scene.
    std::vector<PassMemory> memory;  ///< That its passes are predicted to take.

    // From PreparedExperiment on
    std::string referenceHash;  ///< "" where the experiment has no reference.

    std::optional<VariantResult> result;  ///< Once it was run, or taken over from an earlier run.
};

/// An experiment with its variants, whose graphs are known to be right.
struct Study {
    Experiment experiment;
    std::vector<Variant> variants;
    Value reference;  ///< Its graph with every default filled in; null where there is none.
    /// Ids of passes that run in variants which the command line left out: no mistake of the config.
    std::vector<std::string> deselected;
    const Registry* registry = nullptr;  ///< Outlives the study.

    // From planVariants() on
    std::vector<std::string> warnings;  ///< What may make a result misleading, most with file and line.
    MaskSelections masks;               ///< Of all scenes and sizes of images, where there is a reference.

    /// A variant's graph, wired for one more run of it.
    Graph graphOf(const Variant& variant) const;
    /// The reference as a graph of one pass, for one run of it.
    Graph referenceGraph() const;
};

/// Expands the sweep and wires the graph of every variant, once, and the reference's. Touches no device and
/// no scene.
/// @throws UsageError with file and line; also for a value of a sweep whose pass runs in no variant, while
/// another value's does, and for a pass whose image is written over by one that needs none of the passes
/// before it.
Study wireExperiment(Experiment experiment, const Registry& registry);

/// Passes that no image of a variant depends on, by id: in how many variants that is so.
std::map<std::string, size_t> variantsWithout(const Study& study);

/// Whether any variant runs the pass of this id.
bool runsSomewhere(const Study& study, const std::string& id);

}  // namespace voxray
