#pragma once

#include <string>
#include <vector>

#include "base/value.h"

namespace voxray {

/// Short texts that tell the values of one axis of a sweep apart, for names of variants and for tables. A map
/// is called by what it is (its pass, scene, file or type of light), a list of maps by its entries joined
/// with " + ", an empty list "none". Values that are called alike are told apart by the members that differ,
/// and by all of their text where that is not enough. Equal values have equal texts.
std::vector<std::string> valueLabels(const std::vector<Value>& values);

}  // namespace voxray
