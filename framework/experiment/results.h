#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/measure.h"
#include "image/metrics.h"

/// Rows of the result files and their text.
namespace voxray {

/// One variant's row.
struct VariantResult {
    std::string variant;
    bool ok = false;
    std::string error;  ///< Why it failed.
    std::string device;
    std::string tracer;
    std::vector<std::string> sweepValues;
    double buildMs = 0;
    Percentiles frameMs;
    uint64_t memoryBytes = 0;  ///< As in Measurement, likewise peakBytes.
    uint64_t peakBytes = 0;
    uint64_t rays = 0;
    std::optional<Scores> total;     ///< Empty without a reference.
    std::optional<Scores> indirect;  ///< Empty where the graph writes no indirect light.
    std::vector<PassCost> passes;
    std::vector<ReportedValue> values;
};

/// What a variant's result depends on, by name: compared on --resume.
using VariantInputs = std::vector<std::pair<std::string, std::string>>;

/// Columns of scores, without prefix.
const std::vector<std::string>& scoreColumns();
/// The scores as text in the order of scoreColumns(); "" for those that `metrics` leaves out.
std::vector<std::string> scoreTexts(const Scores& scores, const std::vector<std::string>& metrics);

/// A number with nine digits, '.' as decimal point, "inf" or "nan" where it isn't finite.
std::string numberText(double value);

/// One field of CSV (RFC 4180): quoted where it holds a comma, a quote or a line break.
std::string csvField(const std::string& text);

/// `results.csv`, `passes.csv` and, of what passes reported, `values.csv` (a row a variant, pass, name and
/// frame; no frame in the build).
std::string resultsCsv(const std::vector<VariantResult>& results, const std::vector<std::string>& sweepKeys,
                       const std::vector<std::string>& metrics);
std::string passesCsv(const std::vector<VariantResult>& results);
std::string valuesCsv(const std::vector<VariantResult>& results);

/// `images/<variant>/result.json`, the mark of a finished variant; all numbers survive the round trip.
std::string resultJson(const VariantResult& result, const VariantInputs& inputs);
/// @throws Error for text that resultJson didn't write.
std::pair<VariantResult, VariantInputs> parseResultJson(const std::string& text);

}  // namespace voxray
