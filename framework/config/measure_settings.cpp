#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "base/suggest.h"
#include "config/settings.h"
#include "image/score.h"

namespace voxray {
namespace {

/// Reads masks, whose names become part of names of columns and files.
std::vector<MaskSettings> readMasks(const Value& map) {
    if (!map.isMap())
        throw UsageError(map.where,
                         "measure.masks: expected a map of conditions by name, as in {{floor: {{material: stone}}}}");
    std::vector<MaskSettings> masks;
    for (const auto& [name, conditions] : map.members) {
        const bool isPlain = !name.empty() && name.size() <= 50 && std::ranges::all_of(name, [](unsigned char c) {
            return std::isalnum(c) || c == '_' || c == '-';
        });
        if (!isPlain)
            throw UsageError(conditions.where,
                             "measure.masks: '{}' can't name a mask; use up to 50 letters, digits, '_', '-'", name);
        if (!conditions.isMap() || conditions.members.empty())
            throw UsageError(conditions.where, "measure.masks.{}: expected conditions, as in {{material: stone}}",
                             name);
        MaskSettings mask = readParams<MaskSettings>(conditions, "measure.masks." + name);
        mask.name = name;
        mask.where = conditions.where;
        masks.push_back(std::move(mask));
    }
    return masks;
}

}  // namespace

uint32_t comparedFrames(const MeasureSettings& settings) {
    return settings.compareEvery == 0 ? 1 : (settings.frames - 1) / settings.compareEvery + 1;
}

std::vector<std::string> metricNames() {
    std::vector<std::string> names;
    for (const Metric& metric : metrics()) names.emplace_back(metric.name);
    return names;
}

MeasureSettings readMeasureSettings(const Value& map) {
    MeasureSettings measure = readParams<MeasureSettings>(map, "measure", {"masks", "metrics"});
    if (measure.compareEvery > 0 && comparedFrames(measure) < 3)
        throw UsageError(map.find("compare_every")->where,
                         "measure.compare_every: {} compares {} of {} frames; temporal error needs at least 3: "
                         "raise 'frames'",
                         measure.compareEvery, comparedFrames(measure), measure.frames);
    if (const Value* masks = map.find("masks"); masks && !masks->isNull()) measure.masks = readMasks(*masks);
    const Value* list = map.find("metrics");
    if (!list) {
        measure.metrics = metricNames();
        return measure;
    }
    if (!list->isList()) throw UsageError(list->where, "measure.metrics: expected a list, as in [flip, relmse]");
    const std::vector<std::string> names = metricNames();
    if (list->items.empty())
        throw UsageError(list->where, "measure.metrics: an empty list; leave it out to have all of {}",
                         fmt::join(names, ", "));
    for (const Value& item : list->items) {
        const std::string name = item.asString("measure.metrics");
        if (std::ranges::count(names, name) == 0)
            throw UsageError(item.where, "measure.metrics: unknown metric '{}'{}", name, didYouMean(name, names));
        if (std::ranges::count(measure.metrics, name) > 0)
            throw UsageError(item.where, "measure.metrics: '{}' appears twice", name);
        measure.metrics.push_back(name);
    }
    return measure;
}

}  // namespace voxray
