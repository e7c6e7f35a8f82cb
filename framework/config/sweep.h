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
    Value config;                     ///< The experiment's config with this variant's values, without sweep.
    Setup setup;
};

/// The axes, in the file's order.
std::vector<std::string> sweepKeys(const Experiment& experiment);

/// The values of an axis, which is a list, or a map of named values.
std::vector<Value> sweepValues(const Value& axis);

/// Labels of these values, as in SweepPoint::values: their names in a map, else valueLabels().
std::vector<std::string> sweepLabels(const Value& axis);

/// Takes all values out of a config's sweep but the chosen ones; axes without a choice stay whole.
/// @param choices "axis=value", the value as sweepLabels() has it. @throws UsageError for one that isn't
/// there.
void selectSweepValues(Value& config, const std::vector<std::string>& choices);

/// Label if a variant doesn't have an axis.
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

/// All combinations of the sweep's values; the last axis varies fastest. Without a sweep one variant,
/// "default". If only some variants have a pass, a parameter of it varies these alone; each of the others
/// occurs once, with "-" as its value. An axis is `<id>.<parameter>`, `<id>` (replaces the pass by another or
/// by a chain), `scene...`, `image...`, `seed` or `tracer`.
/// @throws UsageError for another axis, an invalid value, or over 10,000 variants.
std::vector<SweepPoint> expandSweep(const Experiment& experiment);

}  // namespace voxray
