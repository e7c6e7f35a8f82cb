#pragma once

#include <string>
#include <vector>

#include "experiment/prepared_experiment.h"

namespace voxray {

/// What one process can do of an experiment: some samples of a reference, a variant, or the merge of all.
struct Part {
    enum class Kind { Reference, Variant, Merge };
    Kind kind = Kind::Merge;
    std::string id;                  ///< Unique, safe as a file name, the same whenever the parts are listed.
    std::vector<std::string> after;  ///< Ids of the parts that come before it.
    std::string writes;              ///< The file in the results folder that is there when it is done.
    size_t variant = 0;              ///< Index of the variant, or of the first one that has the reference.

    // Of a reference
    std::string hash;
    uint32_t frame = 0;  ///< Of the variant's sequence.
    SamplePart samples;
};

/// Samples a pixel of a reference, which can't be divided into more parts; 1 where there is no reference.
uint32_t referenceSamples(const PreparedExperiment& prepared);

/// All parts, in an order in which they can be done.
/// @param referenceParts how many parts each reference is divided into.
/// @throws UsageError where a reference has fewer samples.
std::vector<Part> partsOf(PreparedExperiment& prepared, uint32_t referenceParts);

/// @throws UsageError for an id that names no part of the experiment, with the nearest one.
Part partNamed(PreparedExperiment& prepared, const std::string& id);

/// The references that a part needs and that can't be had without rendering them: what the ids of their parts
/// begin with.
std::vector<std::string> missingBefore(const Part& part, PreparedExperiment& prepared);

/// What a variant takes as far as it is known before anything is rendered, and estimates of the rest.
struct Forecast {
    std::vector<Graph::PassInfo> passes;
    std::vector<PassMemory> memory;  ///< In the order of the passes.
    uint64_t sceneBytes = 0;         ///< On the device.
    std::string error;               ///< Why it would fail; the others are empty then.
};

/// Plans variants on their scenes and the session's device. Those in a row mostly share a scene.
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

/// What each part is predicted to take, a line each or JSON: id, what it comes after, what it writes,
/// memory in bytes, and cost in paths of a reference or in runs of a variant's graph.
std::string describeParts(PreparedExperiment& prepared, uint32_t referenceParts, bool asJson);

}  // namespace voxray
