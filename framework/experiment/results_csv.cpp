#include <algorithm>

#include "experiment/results.h"
#include "image/seed_error.h"
#include "image/temporal.h"

namespace voxray {
namespace {

const std::vector<std::string> kCostColumns{"build_ms",     "frame_ms_median", "frame_ms_p05",
                                            "frame_ms_p95", "memory_bytes",    "peak_bytes",
                                            "rays",         "tracer_build_ms", "tracer_bytes"};

std::string csvLine(const std::vector<std::string>& fields) {
    std::string line;
    for (size_t i = 0; i < fields.size(); ++i) line += (i ? "," : "") + csvField(fields[i]);
    return line + "\n";
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

/// A column of scores.
struct ScoreColumn {
    std::string name;
    std::string metric;  ///< The metric, if `measure.metrics` can exclude it, else "".
};

/// Appends the columns of a metric and of the bounds of its confidence interval.
/// @param wanted ScoreColumn::metric.
void addColumns(std::vector<ScoreColumn>& columns, const std::string& light, const MetricInfo& metric,
                const std::string& region, const std::string& wanted) {
    columns.push_back({light + metric.name + region, wanted});
    if (!metric.hasInterval) return;
    for (const char* end : {kLow, kHigh}) columns.push_back({light + metric.name + end + region, wanted});
}

/// Columns of the whole image, then of each mask: first metrics of total light, then of indirect light.
std::vector<ScoreColumn> scoreColumns(const MeasureSettings& measure) {
    std::vector<std::string> regions{""};
    for (const MaskSettings& mask : measure.masks) regions.push_back(maskSuffix(mask.name));
    std::vector<ScoreColumn> columns;
    for (const std::string& region : regions)
        for (const std::string light : kLightPrefixes)
            for (const Metric& metric : metrics()) addColumns(columns, light, metric, region, metric.name);
    return columns;
}

std::vector<std::string> scoreFields(const std::vector<ScoreColumn>& columns, const Scores& scores,
                                     const MeasureSettings& measure) {
    std::vector<std::string> fields;
    for (const ScoreColumn& column : columns) {
        const auto value = scores.find(column.name);
        const bool isWanted = column.metric.empty() || std::ranges::count(measure.metrics, column.metric) > 0;
        fields.push_back(isWanted && value != scores.end() ? numberText(value->second) : "");
    }
    return fields;
}

std::vector<std::string> namesOf(const std::vector<ScoreColumn>& columns) {
    std::vector<std::string> names;
    for (const ScoreColumn& column : columns) names.push_back(column.name);
    return names;
}

}  // namespace

std::string numberText(double value) {
    return fmt::format("{:.9g}", value);
}

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::vector<std::string> numberColumns(const MeasureSettings& measure) {
    std::vector<std::string> columns;
    for (const ScoreColumn& column : scoreColumns(measure))
        if (std::ranges::count(measure.metrics, column.metric) > 0) columns.push_back(column.name);
    const auto addLights = [&](std::span<const MetricInfo> metrics) {
        for (const std::string light : kLightPrefixes)
            for (const MetricInfo& metric : metrics) columns.push_back(light + metric.name);
    };
    if (measure.secondSeed) addLights(seedMetrics());
    if (measure.compareEvery > 0) addLights(temporalMetrics());
    append(columns, kCostColumns);
    return columns;
}

std::string resultsCsv(const std::vector<VariantResult>& results, const std::vector<std::string>& sweepKeys,
                       const MeasureSettings& measure) {
    std::vector<ScoreColumn> columns = scoreColumns(measure);
    const auto addLights = [&](std::span<const MetricInfo> metrics) {
        for (const std::string light : kLightPrefixes)
            for (const MetricInfo& metric : metrics) addColumns(columns, light, metric, "", "");
    };
    if (measure.secondSeed) addLights(seedMetrics());
    if (measure.compareEvery > 0) addLights(temporalMetrics());
    std::vector<std::string> header{"variant", "name", "status", "error", "device", "tracer"};
    append(header, sweepKeys);
    append(header, kCostColumns);
    append(header, namesOf(columns));

    std::string text = csvLine(header);
    for (const VariantResult& r : results) {
        std::vector<std::string> fields{r.variant, r.name, r.ok ? "ok" : "failed", r.error, r.device, r.tracer};
        append(fields, r.sweepValues);
        if (r.ok)
            append(fields, {numberText(r.buildMs), numberText(r.frameMs.median), numberText(r.frameMs.p05),
                            numberText(r.frameMs.p95), std::to_string(r.memoryBytes), std::to_string(r.peakBytes),
                            std::to_string(r.rays), numberText(r.tracerBuildMs), std::to_string(r.tracerBytes)});
        else
            append(fields, std::vector<std::string>(kCostColumns.size()));
        append(fields, scoreFields(columns, r.scores, measure));
        text += csvLine(fields);
    }
    return text;
}

std::string passesCsv(const std::vector<VariantResult>& results) {
    std::string text = csvLine({"variant", "pass", "phase", "ms_median", "ms_p05", "ms_p95", "rays", "voxel_steps",
                                "memory_bytes", "scratch_bytes", "dispatches", "host_waits", "host_bytes", "clock"});
    for (const VariantResult& r : results)
        for (const PassCost& p : r.passes)
            text += csvLine({r.variant, p.id, nameOf(p.phase), numberText(p.milliseconds.median),
                             numberText(p.milliseconds.p05), numberText(p.milliseconds.p95), std::to_string(p.rays),
                             std::to_string(p.voxelSteps), std::to_string(p.memoryBytes),
                             std::to_string(p.scratchBytes), std::to_string(p.work.dispatches),
                             std::to_string(p.work.waits), std::to_string(p.work.hostBytes), p.clock});
    return text;
}

std::string valuesCsv(const std::vector<VariantResult>& results) {
    std::string text = csvLine({"variant", "pass", "name", "frame", "value"});
    for (const VariantResult& r : results)
        for (const ReportedValue& v : r.values)
            text += csvLine({r.variant, v.pass, v.name, v.frame ? std::to_string(*v.frame) : "", numberText(v.value)});
    return text;
}

std::string framesCsv(const std::vector<VariantResult>& results, const MeasureSettings& measure) {
    std::vector<ScoreColumn> columns = scoreColumns(measure);
    for (const std::string light : kLightPrefixes) columns.push_back({light + temporalMetrics()[0].name, ""});
    // Only if a light is switched off
    for (const std::string light : kLightPrefixes)
        for (const char* name : {"afterglow", "frames_lit"})
            if (std::ranges::any_of(results, [&](const VariantResult& r) {
                    return std::ranges::any_of(
                        r.frames, [&](const FrameScores& frame) { return frame.scores.contains(light + name); });
                }))
                columns.push_back({light + name, ""});
    std::vector<std::string> header{"variant", "frame"};
    append(header, namesOf(columns));
    std::string text = csvLine(header);
    for (const VariantResult& r : results)
        for (const FrameScores& frame : r.frames) {
            std::vector<std::string> fields{r.variant, std::to_string(frame.frame)};
            append(fields, scoreFields(columns, frame.scores, measure));
            text += csvLine(fields);
        }
    return text;
}

}  // namespace voxray
