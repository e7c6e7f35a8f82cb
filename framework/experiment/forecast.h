#pragma once

#include <string>
#include <vector>

#include "experiment/prepared_experiment.h"

namespace voxray {

/// What a variant is predicted to take, before anything is rendered.
struct Forecast {
    std::vector<Graph::PassInfo> passes;
    std::vector<PassMemory> memory;  ///< In the order of the passes.
    uint64_t sceneBytes = 0;         ///< On the device.
    std::string error;               ///< Why it would fail; the others are empty then.
};

/// Plans a variant on its scene and the session's device.
Forecast forecast(WiredVariant& variant, PreparedExperiment& prepared);

/// Prints variants, passes and predicted memory. @return how many variants would fail. @throws Interrupted.
size_t printForecasts(PreparedExperiment& prepared);

}  // namespace voxray
