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

/// Names of output ports: the image that is compared with the reference, and its indirect light.
inline constexpr const char* kComparedImage = "final";
inline constexpr const char* kIndirectImage = "indirect";
/// Names of the ports whose sum is the compared image.
inline constexpr const char* kPartsOfLight[] = {"direct", kIndirectImage};

// An Experiment is a parsed config. makeStudy() expands its sweep into a Study, which needs no scene. A
// PreparedExperiment is a Study that was planned and checked on its scenes and a device.

/// One combination of the sweep's values. Its members are set step by step: the graph by makeStudy(), memory
/// by planVariants(), the reference by PreparedExperiment, the result by the run.
struct Variant : SweepPoint {
    /// Makes the graph and connects its ports. @throws UsageError with file and line.
    Variant(SweepPoint point, const Registry& registry);

    /// Holds only passes that the compared images depend on. A graph has state, so it is run once; graphOf() makes
    /// another.
    Graph graph;
    Value resolved;                         ///< Config tree of the graph including all default values.
    std::vector<std::string> culledPasses;  ///< Ids.
    /// For each compared image: the parameters that lower its noise (Graph::noiseParameters()).
    std::map<std::string, std::vector<std::string>> noiseParameters;
    std::vector<UnusedSetting> unused;  ///< Parameters without effect, named "<id>.<parameter>".

    // Set by planVariants()
    std::string sceneKey;            ///< SceneLoader::key() of its scene.
    std::vector<PassMemory> memory;  ///< Planned memory of each pass.

    // Set by PreparedExperiment
    std::string referenceHash;  ///< "" if the experiment has no reference.

    std::optional<VariantResult> result;  ///< Measured in this run, or read from an earlier one.
};

/// An experiment with all variants of its sweep, whose graphs have passed all checks that need no scene.
struct Study {
    Experiment experiment;
    std::vector<Variant> variants;
    Value reference;  ///< Config tree of the reference's graph including all default values; null if there is none.
    /// Ids of passes that run only in variants that --only leaves out. They are not reported as unused.
    std::vector<std::string> excludedPasses;
    const Registry* registry = nullptr;  ///< Must outlive the study.

    // Set by planVariants()
    std::vector<std::string> warnings;  ///< Most of them with file and line.
    MaskSelections masks;               ///< Pixels that masks select, for each scene and image size.

    /// Makes a variant's graph again, for another run of it.
    Graph graphOf(const Variant& variant) const;
    /// Makes the graph of the reference, which has a single pass, for one run of it.
    Graph referenceGraph() const;
};

/// Expands the sweep, makes the graphs of all variants and of the reference, and checks them. Needs no device
/// and no scene file.
/// @throws UsageError with file and line
/// - for an invalid graph;
/// - if the sweep tries several passes in one place, and one of them runs in no variant, though another does;
/// - for a pass that overwrites the compared image of an earlier pass without reading any of its outputs.
Study makeStudy(Experiment experiment, const Registry& registry);

/// Number of variants in which each pass is culled, by id.
std::map<std::string, size_t> cullCounts(const Study& study);

/// Whether the pass with this id runs in any variant.
bool runsSomewhere(const Study& study, const std::string& id);

}  // namespace voxray
