#pragma once

#include <string>
#include <vector>

#include "experiment/prepared_experiment.h"

namespace voxray {

/// A part of an experiment for one process: some samples of a reference, a variant, or the merge of all.
struct Part {
    enum class Kind { Reference, Variant, Merge };
    Kind kind = Kind::Merge;
    std::string id;                  ///< Unique, valid as a file name, the same whenever the parts are listed.
    std::vector<std::string> after;  ///< Ids of the parts that it depends on.
    std::string writes;              ///< The file in the results folder that exists when the part is done.
    size_t variant = 0;              ///< Index of the variant, or of the first one with this reference.

    // Only for a reference
    std::string hash;
    uint32_t frame = 0;  ///< Frame of the variant's sequence.
    SamplePart samples;
};

/// All parts, in an order in which they can be done.
/// @param referenceParts number of parts of each reference.
/// @throws UsageError if a reference has fewer samples.
std::vector<Part> partsOf(PreparedExperiment& prepared, uint32_t referenceParts);

/// The part with an id. @throws UsageError if there is none, with the most similar id.
Part partNamed(PreparedExperiment& prepared, const std::string& id);

/// The references that a part needs and that are missing: the common prefixes of the ids of their parts.
std::vector<std::string> missingBefore(const Part& part, PreparedExperiment& prepared);

/// Planned and estimated memory of a variant before anything is rendered.
struct Forecast {
    std::vector<Graph::PassInfo> passes;
    std::vector<PassMemory> memory;  ///< In the order of the passes.
    uint64_t sceneBytes = 0;         ///< On the device.
    std::string error;               ///< Why it would fail; then the others are empty.
};

/// Plans variants on their scenes and the session's device. Consecutive variants usually share a scene.
class Forecaster {
 public:
    /// The experiment must outlive this object.
    explicit Forecaster(PreparedExperiment& prepared) : prepared_(prepared) {}
    Forecast forecast(Variant& variant);

 private:
    PreparedExperiment& prepared_;
    std::string sceneKey_;
    PreparedScene scene_;
    uint64_t sceneBytes_ = 0;
};

/// Prints variants, passes and their memory. @return how many variants would fail. @throws Interrupted.
size_t printForecasts(PreparedExperiment& prepared);

/// A list of all parts, as lines or as JSON: id, dependencies, output file, estimated memory in bytes, and
/// cost in paths of a reference or in runs of a variant's graph.
std::string describeParts(PreparedExperiment& prepared, uint32_t referenceParts, bool asJson);

}  // namespace voxray
