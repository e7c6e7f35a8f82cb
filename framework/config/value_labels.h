#pragma once

#include <string>
#include <vector>

#include "base/value.h"

namespace voxray {

/// Short, distinct labels of the values of a sweep's axis, for names of variants and for tables. The label of
/// a map is its pass, scene, file or type of light; that of a list of maps has the labels of its entries,
/// joined by " + "; that of an empty list is "none". If labels are equal, differing members are appended, or
/// the full text is used. Equal values have equal labels.
std::vector<std::string> valueLabels(const std::vector<Value>& values);

}  // namespace voxray
