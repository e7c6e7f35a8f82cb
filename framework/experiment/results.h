#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/measure.h"
#include "image/score.h"

/// Data of the result files, and their text formats.
namespace voxray {

/// A measured frame that was compared with its reference.
struct FrameScores {
    uint32_t frame = 0;
    Scores scores;  ///< By column.
};

/// The result of a variant: its row of results.csv.
struct VariantResult {
    std::string variant;  ///< Its id, SweepPoint::id.
    std::string name;     ///< SweepPoint::name.
    bool ok = false;
    std::string error;  ///< Why it failed.
    std::string device;
    std::string tracer;
    std::vector<std::string> sweepValues;
    std::string session;  ///< Start time of the process that measured it: UTC, ISO 8601; empty: unknown.
    double buildMs = 0;
    Percentiles frameMs;
    uint64_t memoryBytes = 0;  ///< This and peakBytes are those of Measurement.
    uint64_t peakBytes = 0;
    uint64_t rays = 0;
    double tracerBuildMs = 0;  ///< This and tracerBytes are those of Measurement.
    uint64_t tracerBytes = 0;
    Scores scores;  ///< By column. Only of images that the graph writes, and only with a reference.
    std::vector<PassCost> passes;
    std::vector<ReportedValue> values;
    std::vector<FrameScores> frames;  ///< Empty if only frame 0 is compared.
};

/// The inputs that a variant's result depends on, by name. They are compared on --resume.
using VariantInputs = std::vector<std::pair<std::string, std::string>>;

/// Prefixes of the columns of total and of indirect light.
inline constexpr const char* kLightPrefixes[] = {"", "indirect_"};

/// Suffix of the columns of the pixels that a mask selects.
inline std::string maskSuffix(const std::string& mask) {
    return "@" + mask;
}

/// A number with nine digits and '.' as decimal point; "inf" or "nan" if it isn't finite.
std::string numberText(double value);

/// A field of CSV (RFC 4180): quoted if it contains a comma, a quote or a line break.
std::string csvField(const std::string& text);

/// Columns of results.csv that have a score or a cost if no variant fails.
std::vector<std::string> numberColumns(const MeasureSettings& measure);

/// `results.csv`: one row for each variant. There are columns for the scores of all metrics, lights and
/// masks, and for the temporal error if frames are compared. Those of excluded metrics are empty.
std::string resultsCsv(const std::vector<VariantResult>& results, const std::vector<std::string>& sweepKeys,
                       const MeasureSettings& measure);
/// `passes.csv`: one row for each variant, pass and phase.
std::string passesCsv(const std::vector<VariantResult>& results);
/// `values.csv`: one row for each variant, pass, reported value and frame; the frame is empty in the build.
std::string valuesCsv(const std::vector<VariantResult>& results);
/// `frames.csv`: one row for each variant and compared frame; scores as in results.csv.
std::string framesCsv(const std::vector<VariantResult>& results, const MeasureSettings& measure);

/// "build" or "frame".
const char* nameOf(Phase phase);

/// A number, or a text if it is not finite, which JSON does not support (e.g. PSNR of equal images).
nlohmann::ordered_json numberJson(double value);
/// Scores by column, with `suffix` appended to the names of the columns.
nlohmann::ordered_json scoresJson(const Scores& scores, const std::string& suffix = "");
/// The text at a path of keys in a JSON object; "" if there is none. The rest of the object is not parsed,
/// since it may have thousands of variants.
std::string jsonTextAt(std::string_view json, const std::vector<std::string>& path);

/// `images/<variant>/result.json`, which exists if the variant has finished. Numbers are stored exactly.
std::string resultJson(const VariantResult& result, const VariantInputs& inputs);
/// @throws Error for text that resultJson didn't write.
std::pair<VariantResult, VariantInputs> parseResultJson(const std::string& text);

}  // namespace voxray
