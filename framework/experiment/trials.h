#pragma once

#include <string>
#include <vector>

#include "experiment/study.h"

/// What a search for the cheapest variant (framework/trials) needs to know of an experiment.
namespace voxray {

/// Values of a pass's parameter to search, out of its schema: all of them where it takes few, else the
/// config's own value and its halves and doubles, three of each, within the range.
/// @param path `<id>.<parameter>`. @return an assignment as `--set` takes it, of the axis to the sweep.
/// @throws UsageError for a pass or parameter that the graph lacks, or one whose values have no order or
/// range.
std::string axisOfParameter(const Experiment& experiment, const std::string& path, const Registry& registry);

/// @param targets texts such as "indirect_relmse=0.02".
/// @throws UsageError for one without a number, of a column that results.csv lacks or leaves empty, or that
/// nothing but a perfect image meets.
void checkTargets(const std::vector<std::string>& targets, const MeasureSettings& measure);

/// The experiment's sweep as JSON: `config`, without the graph and the sweep; `axes` by path; `swaps`,
/// whether an axis swaps a pass; `variants` with `name`, `values` (text, "-" where an axis does not reach it)
/// and `graph`.
/// @throws UsageError where there is no reference, or the sweep varies more than the graph.
std::string trialsJson(const Study& wired);

}  // namespace voxray
