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

/// Ports: the image that is compared with the reference, and its indirect light.
inline constexpr const char* kComparedImage = "final";
inline constexpr const char* kIndirectImage = "indirect";
/// Ports whose sum is the compared image.
inline constexpr const char* kPartsOfLight[] = {"direct", kIndirectImage};

/// One combination of the sweep's values. Its members are filled in step by step: graph (makeStudy),
/// memory (planVariants), reference (PreparedExperiment), result (run).
struct Variant : SweepPoint {
    /// Makes its graph and connects the ports. @throws UsageError with file and line.
    Variant(SweepPoint point, const Registry& registry);

    Graph graph;     ///< Only passes that the compared images depend on. A graph keeps state: one a run.
    Value resolved;  ///< The graph with every default filled in.
    std::vector<std::string> leftOut;  ///< Ids of the passes that were culled.
    /// By compared image: the parameters that lower its noise (Graph::noiseParameters()).
    std::map<std::string, std::vector<std::string>> noiseParameters;
    std::vector<UnusedSetting> unused;  ///< Parameters without effect: "<id>.<parameter>".

    // From planVariants() on
    std::string sceneKey;            ///< SceneLoader::key() of its scene.
    std::vector<PassMemory> memory;  ///< Memory of its passes, as planned.

    // From PreparedExperiment on
    std::string referenceHash;  ///< "" where the experiment has no reference.

    std::optional<VariantResult> result;  ///< Measured now, or read from an earlier run.
};

/// An experiment with its variants, whose graphs have passed all checks that need no scene.
struct Study {
    Experiment experiment;
    std::vector<Variant> variants;
    Value reference;  ///< Its graph with every default filled in; null where there is none.
    /// Ids of passes that run only in variants which --only excludes. They are not reported as unused.
    std::vector<std::string> deselected;
    const Registry* registry = nullptr;  ///< Outlives the study.

    // From planVariants() on
    std::vector<std::string> warnings;  ///< Warnings, most with file and line.
    MaskSelections masks;               ///< Pixels that masks select, by scene and image size.

    /// A variant's graph, wired for one more run of it.
    Graph graphOf(const Variant& variant) const;
    /// The reference as a graph of one pass, for one run of it.
    Graph referenceGraph() const;
};

/// Expands the sweep, makes the graph of every variant, and checks the reference's. Touches no device and no
/// scene.
/// @throws UsageError with file and line: a wrong graph; a swept pass that no image of its variants depends
/// on, while one of another value is used; a pass that overwrites the compared image of an earlier pass
/// without reading anything of it.
Study makeStudy(Experiment experiment, const Registry& registry);

/// Culled passes by id, with the number of variants that cull them.
std::map<std::string, size_t> variantsWithout(const Study& study);

/// Whether any variant runs the pass of this id.
bool runsSomewhere(const Study& study, const std::string& id);

}  // namespace voxray
