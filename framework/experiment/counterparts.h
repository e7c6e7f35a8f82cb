#pragma once

#include <string>
#include <vector>

#include "experiment/study.h"

namespace voxray {

/// A stage of a graph whose own error a counterpart takes out.
struct SwappedStage {
    std::string name;
    std::string cure;                ///< What lowers its error.
    std::vector<std::string> needs;  ///< Stages that are swapped whenever it is.
    std::vector<std::string>
        changes;  ///< What its counterpart changes, as in "voxelize.resolution 64 → 256".
};

/// A variant, and what it is with each set of its stages swapped for their counterparts.
struct SwapPlan {
    std::vector<SwappedStage> stages;             ///< In the table's order.
    std::vector<std::vector<std::string>> swaps;  ///< Every set of stages that holds what its stages need.
    Experiment experiment;                        ///< A sweep over `explained`: a graph for each set.

    /// Stages and sets as JSON, for the report.
    std::string json() const;
};

/// @param table passes/counterparts.yaml, which says what its entries mean.
/// @throws UsageError where a pass of the graph has no counterpart, nothing is left to swap, or there is no
/// reference.
SwapPlan planSwaps(const Value& table, const Study& wired, const Variant& variant, const Registry& registry);

/// Names of all passes that the table knows, also of those that it has no counterpart for.
/// @throws UsageError where it names one twice as `exact` or `unknown`, or both.
std::vector<std::string> passesInTable(const Value& table);

}  // namespace voxray
