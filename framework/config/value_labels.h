#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/value.h"

namespace voxray {

/// Short, distinct labels of the values of a sweep's axis, for names of variants and for tables. The label of
/// a map is its scene, file or type of light; that of a list of maps has the labels of its entries,
/// joined by " + "; that of an empty list is "none". If labels are equal, differing members are appended, or
/// the full text is used. Equal values have equal labels.
std::vector<std::string> valueLabels(const std::vector<Value>& values);

/// By the name of a pass that denoises another pass's result: the word for what it makes of it, such as "filtered".
using FilterLabels = std::map<std::string, std::string>;

/// As valueLabels(), of passes and chains of passes. A chain's label is its last pass that is no filter, followed by
/// the words of the filters after it: "path_trace, spp 4, filtered". Where the sweep has several chains with this last
/// pass, its first parameter that differs among them is told, and as many more parameters and passes, from the end of
/// the chain, as tell the chains apart. A parameter that passes of several kinds have is told with its pass:
/// "inject_rsm.bounces 2".
std::vector<std::string> chainLabels(const std::vector<Value>& chains, const FilterLabels& filters);

}  // namespace voxray
