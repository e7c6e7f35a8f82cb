#pragma once

#include <string>
#include <vector>

#include "experiment/prepared_experiment.h"

namespace voxray {

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

}  // namespace voxray
