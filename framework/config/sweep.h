#pragma once

#include <set>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/value_labels.h"

namespace voxray {

/// One point of the sweep.
struct SweepPoint {
    std::string name;                 ///< Unique, e.g. "resolution 64, gather_cones, cones 16".
    std::string id;                   ///< The name as a file name, unique too: "resolution-64-gather_cones-cones-16".
    std::vector<std::string> values;  ///< Label of each axis' value, in the order of sweepKeys().
    Value config;                     ///< The experiment's config with this variant's values and without sweep.
    Setup setup;
};

/// Paths of the axes, in the file's order.
std::vector<std::string> sweepKeys(const Experiment& experiment);

/// The values of an axis, which is a list, or a map of named values.
std::vector<Value> sweepValues(const Value& axis);

/// Labels of an axis' values, as in SweepPoint::values: their keys in a map, else chainLabels() where the
/// axis replaces a pass, or valueLabels(). @param path of the axis.
std::vector<std::string> sweepLabels(const std::string& path, const Value& axis, const FilterLabels& filters);

/// Removes all values of a config's sweep except the selected ones. Axes without a selected value are
/// unchanged.
/// @param choices "axis=label" with labels of sweepLabels(). @throws UsageError for one that doesn't exist.
void selectSweepValues(Value& config, const std::vector<std::string>& choices, const FilterLabels& filters);

/// Label of an axis that a variant doesn't have.
inline constexpr const char* kNoValue = "-";

/// Sets names and ids of variants, which are unique, from their values. A value is named by its key in the
/// config, a pass or a scene by its label alone, any other value by its parameter too: "resolution 64".
class VariantNames {
 public:
    VariantNames(const Experiment& experiment, const FilterLabels& filters);
    void name(SweepPoint& variant);

 private:
    struct AxisLabel {
        std::string label;
        bool isWord;  ///< Its values' labels need no parameter before them, unless they are numbers.
    };
    std::vector<AxisLabel> axes_;
    std::set<std::string> names_, ids_;
};

/// All combinations of the sweep's values; the last axis varies fastest. Without a sweep there is one
/// variant, "default". If only some variants have a pass, an axis of its parameter is varied only in these;
/// each of the other variants occurs once, with "-" as its value. An axis is `<id>.<parameter>`, `<id>`
/// (replaces the pass by another one or by a chain), `scene...`, `image...`, `seed` or `tracer`.
/// @throws UsageError for another axis, an invalid value, or over 10,000 variants.
std::vector<SweepPoint> expandSweep(const Experiment& experiment, const FilterLabels& filters);

}  // namespace voxray
