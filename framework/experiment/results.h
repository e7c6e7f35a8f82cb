#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/measure.h"
#include "image/score.h"

/// Rows of the result files and their text.
namespace voxray {

/// A measured frame that was compared with its reference.
struct FrameScores {
    uint32_t frame = 0;
    Scores scores;  ///< By column.
};

/// One variant's row.
struct VariantResult {
    std::string variant;
    bool ok = false;
    std::string error;  ///< Why it failed.
    std::string device;
    std::string tracer;
    std::vector<std::string> sweepValues;
    std::string session;  ///< When the process that measured it began: UTC, ISO 8601; empty: unknown.
    double buildMs = 0;
    Percentiles frameMs;
    uint64_t memoryBytes = 0;  ///< As in Measurement, likewise peakBytes.
    uint64_t peakBytes = 0;
    uint64_t rays = 0;
    Scores scores;  ///< By column; without those of a light that the graph doesn't write, or of no reference.
    std::vector<PassCost> passes;
    std::vector<ReportedValue> values;
    std::vector<FrameScores> frames;  ///< Empty where frame 0 alone is compared.
};

/// What a variant's result depends on, by name: compared on --resume.
using VariantInputs = std::vector<std::pair<std::string, std::string>>;

/// What columns of the total and of the indirect light begin with.
inline constexpr const char* kLightPrefixes[] = {"", "indirect_"};

/// What columns of the pixels under a mask end with.
inline std::string maskSuffix(const std::string& mask) {
    return "@" + mask;
}

/// A number with nine digits, '.' as decimal point, "inf" or "nan" where it isn't finite.
std::string numberText(double value);

/// One field of CSV (RFC 4180): quoted where it holds a comma, a quote or a line break.
std::string csvField(const std::string& text);

/// Columns of results.csv that hold a score or a cost, where nothing fails.
std::vector<std::string> numberColumns(const MeasureSettings& measure);

/// `results.csv`: one row for each variant. Columns of scores are those of the metrics, lights and masks that
/// are asked for, and of temporal error where frames are compared; metrics that `measure` leaves out stay
/// empty.
std::string resultsCsv(const std::vector<VariantResult>& results, const std::vector<std::string>& sweepKeys,
                       const MeasureSettings& measure);
/// `passes.csv`: one row for each variant, pass and phase.
std::string passesCsv(const std::vector<VariantResult>& results);
/// `values.csv`, of what passes reported: one row for each variant, pass, name and frame; no frame in the
/// build.
std::string valuesCsv(const std::vector<VariantResult>& results);
/// `frames.csv`: one row for each variant and compared frame; scores as in results.csv.
std::string framesCsv(const std::vector<VariantResult>& results, const MeasureSettings& measure);

/// "build" or "frame".
const char* nameOf(Phase phase);

/// A number; as text where it is infinite, which JSON has not: PSNR of equal images.
nlohmann::ordered_json numberJson(double value);
/// Scores by column, each with `suffix` behind it.
nlohmann::ordered_json scoresJson(const Scores& scores, const std::string& suffix = "");
/// The text at a path of keys in a JSON object, "" where there is none. What follows it is not read: it may
/// be of thousands of variants.
std::string jsonTextAt(std::string_view json, const std::vector<std::string>& path);

/// `images/<variant>/result.json`, the mark of a finished variant; all numbers survive the round trip.
std::string resultJson(const VariantResult& result, const VariantInputs& inputs);
/// @throws Error for text that resultJson didn't write.
std::pair<VariantResult, VariantInputs> parseResultJson(const std::string& text);

}  // namespace voxray
