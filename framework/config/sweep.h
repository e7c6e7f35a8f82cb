#pragma once

#include <set>
#include <string>
#include <vector>

#include "config/config.h"

namespace voxray {

/// One point of the sweep.
struct SweepPoint {
    std::string name;  ///< Unique, safe as a file name, e.g. "resolution-64_inject-inject_rsm".
    std::vector<std::string> values;  ///< Text of each axis' value, in the order of sweepKeys().
    Value config;  ///< The experiment's config with this variant's values in place, no sweep.
    Setup setup;
};

/// The axes, in the file's order.
std::vector<std::string> sweepKeys(const Experiment& experiment);

/// The values of an axis, which is a list of values, or a map that gives each value a name.
std::vector<Value> sweepValues(const Value& axis);

/// Short texts of these values, as in SweepPoint::values: the names that a map gives them, else
/// valueLabels().
std::vector<std::string> sweepLabels(const Value& axis);

/// Takes all values out of a config's sweep but the chosen ones; axes without a choice stay whole.
/// @param choices "axis=value", the value as sweepLabels() has it. @throws UsageError for one that isn't
/// there.
void keepOnly(Value& config, const std::vector<std::string>& choices);

/// In place of the value of an axis that a variant does not have.
inline constexpr const char* kNoValue = "-";

/// Names of variants by their values, unique and safe as file names.
class VariantNames {
 public:
    explicit VariantNames(const Experiment& experiment);
    /// @param values in the order of sweepKeys().
    std::string next(const std::vector<std::string>& values);

 private:
    std::vector<std::string> labels_;
    std::set<std::string> taken_;
};

/// Every combination of the sweep's values; the last axis runs fastest. One variant, "default", without a
/// sweep. Where a pass stands in the graphs of some variants alone, as one of a chain, a parameter of it
/// varies these; each of the others comes once, with "-" in place of the value. An axis is
/// `<id>.<parameter>`, `<id>` (swaps the whole pass for another or for a chain), `scene...`, `image...`,
/// `seed` or `tracer`.
/// @throws UsageError for another axis, a value that the config can't hold, or over 10,000 variants.
std::vector<SweepPoint> expandSweep(const Experiment& experiment);

}  // namespace voxray
