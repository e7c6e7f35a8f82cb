#pragma once

#include <set>
#include <string>
#include <vector>

#include "config/config.h"

namespace voxray {

/// One point of the sweep.
struct SweepPoint {
    std::string name;                 ///< Unique, safe as a file name, e.g. "resolution-64_inject-inject_rsm".
    std::vector<std::string> values;  ///< Label of each axis' value, in the order of sweepKeys().
    Value config;                     ///< The experiment's config with this variant's values and without sweep.
    Setup setup;
};

/// Paths of the axes, in the file's order.
std::vector<std::string> sweepKeys(const Experiment& experiment);

/// The values of an axis, which is a list, or a map of named values.
std::vector<Value> sweepValues(const Value& axis);

/// Labels of these values, as in SweepPoint::values: their names in a map, else valueLabels().
std::vector<std::string> sweepLabels(const Value& axis);

/// Removes all values of a config's sweep except the selected ones. Axes without a selected value are
/// unchanged.
/// @param choices "axis=label" with labels of sweepLabels(). @throws UsageError for one that doesn't exist.
void selectSweepValues(Value& config, const std::vector<std::string>& choices);

/// Label of an axis that a variant doesn't have.
inline constexpr const char* kNoValue = "-";

/// Makes names of variants from their values. They are unique and valid as file names.
class VariantNames {
 public:
    explicit VariantNames(const Experiment& experiment);
    /// @param values in the order of sweepKeys().
    std::string next(const std::vector<std::string>& values);

 private:
    std::vector<std::string> labels_;
    std::set<std::string> taken_;
};

/// All combinations of the sweep's values; the last axis varies fastest. Without a sweep there is one
/// variant, "default". If only some variants have a pass, an axis of its parameter is varied only in these;
/// each of the other variants occurs once, with "-" as its value. An axis is `<id>.<parameter>`, `<id>`
/// (replaces the pass by another one or by a chain), `scene...`, `image...`, `seed` or `tracer`.
/// @throws UsageError for another axis, an invalid value, or over 10,000 variants.
std::vector<SweepPoint> expandSweep(const Experiment& experiment);

}  // namespace voxray
