#include "experiment/trials.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/suggest.h"
#include "config/overrides.h"
#include "experiment/results.h"

namespace voxray {
namespace {

constexpr int kDoubles = 3;
constexpr size_t kFewChoices = 2 * kDoubles + 1;

/// Halves and doubles of a number, those within [min, max].
std::vector<std::string> spread(double own, double min, double max, bool isInteger) {
    std::vector<std::string> values;
    for (int step = -kDoubles; step <= kDoubles; ++step) {
        double value = std::ldexp(own, step);
        if (isInteger) value = std::round(value);
        value = std::clamp(value, min, max);
        const std::string text = isInteger ? fmt::format("{:.0f}", value) : fmt::format("{:.9g}", value);
        if (values.empty() || values.back() != text) values.push_back(text);
    }
    return values;
}

std::vector<std::string> valuesOf(const ParameterDoc& doc, const std::string& own, const std::string& path) {
    if (doc.type == "boolean") return {"false", "true"};
    if (!doc.choices.empty()) {
        const auto at = std::ranges::find(doc.choices, own);
        if (doc.choices.size() <= kFewChoices || at == doc.choices.end()) return doc.choices;
        const auto before = std::min<ptrdiff_t>(kDoubles, at - doc.choices.begin());
        const auto after = std::min<ptrdiff_t>(kDoubles + 1, doc.choices.end() - at);
        return {at - before, at + after};
    }
    const bool isInteger = doc.type == "integer";
    if (!isInteger && doc.type != "number")
        throw UsageError("--vary {}: it is no number and no choice: list its values in the config's sweep",
                         path);
    const double value = std::stod(own);
    if (value == 0)
        throw UsageError(
            "--vary {}: its value is 0, which has no doubles: list its values in the config's sweep", path);
    return spread(value, doc.min.empty() ? -HUGE_VAL : std::stod(doc.min),
                  doc.max.empty() ? HUGE_VAL : std::stod(doc.max), isInteger);
}

}  // namespace

std::string axisOfParameter(const Experiment& experiment, const std::string& path, const Registry& registry) {
    const size_t dot = path.rfind('.');
    const std::string id = path.substr(0, dot), name = dot == std::string::npos ? "" : path.substr(dot + 1);
    std::vector<std::string> ids;
    for (const Value& entry : experiment.setup.graph.items) {
        ids.push_back(passId(entry));
        if (ids.back() != id) continue;
        const PassKind& kind = registry.require(entry.find("pass")->asString("pass"), entry.where);
        const Value resolved = kind.resolve(entry, id, Graph::reservedKeys());
        std::vector<std::string> names;
        for (const ParameterDoc& doc : kind.parameters) {
            names.push_back(doc.name);
            if (doc.name == name)
                return fmt::format("sweep.{}=[{}]", path,
                                   fmt::join(valuesOf(doc, resolved.find(name)->text(), path), ", "));
        }
        throw UsageError("--vary {}: '{}' has no parameter '{}'{}", path, id, name, didYouMean(name, names));
    }
    throw UsageError("--vary {}: no pass '{}' in the graph{}", path, id, didYouMean(id, ids));
}

void checkTargets(const std::vector<std::string>& targets, const MeasureSettings& measure) {
    const std::vector<std::string> columns = numberColumns(measure);
    for (const std::string& target : targets) {
        const size_t equals = target.rfind('=');
        const Value number = Value::fromScalar(equals == std::string::npos ? "" : target.substr(equals + 1));
        if (!number.isNumber())
            throw UsageError("--target {}: expected NAME=VALUE, as in indirect_relmse=0.02", target);
        const std::string column = target.substr(0, equals);
        if (std::ranges::count(columns, column) == 0)
            throw UsageError("--target {}: no such column of results.csv{}", column,
                             didYouMean(column, columns));
        const std::string_view metric = std::string_view(column).substr(0, column.find('@'));
        const double value = number.asNumber(column);
        const bool isMet = metric.ends_with("ssim")         ? value < 1
                           : metric.ends_with("mean_ratio") ? value != 1
                           : metric.ends_with("psnr_db")    ? true
                                                            : value > 0;
        if (!isMet)
            throw UsageError(
                "--target {}: a target is above 0 and can be met: ssim below 1, mean_ratio other than 1",
                target);
    }
}

std::string trialsJson(const Study& wired) {
    const Experiment& experiment = wired.experiment;
    if (experiment.reference.isNull())
        throw UsageError(experiment.config.where,
                         "there is no 'reference', so there is no error to aim at: write one, as in "
                         "{{pass: path_trace, spp: 1024, bounces: 8}}");
    Value whole = Value::map(), axes = Value::list(), swaps = Value::list(), variants = Value::list();
    for (const auto& [path, values] : experiment.sweep.members) {
        const std::string first = path.substr(0, path.find('.'));
        for (const char* fixed : {"scene", "image", "seed", "tracer"})
            if (first == fixed)
                throw UsageError(
                    values.where,
                    "the sweep varies '{0}', and a search is for one graph: choose a value with --set "
                    "'sweep.{0}=null' --set {0}=VALUE",
                    path);
        axes.items.push_back(Value::fromScalar(path, true));
        swaps.items.push_back(Value::fromScalar(path == first ? "true" : "false"));
    }
    for (const Variant& variant : wired.variants) {
        Value entry = Value::map(), values = Value::list();
        for (const std::string& text : variant.values) values.items.push_back(Value::fromScalar(text, true));
        entry.set("name", Value::fromScalar(variant.name, true));
        entry.set("values", std::move(values));
        entry.set("graph", variant.setup.graph);
        variants.items.push_back(std::move(entry));
    }
    Value config = experiment.config;
    config.erase("graph");
    config.erase("sweep");
    whole.set("config", std::move(config));
    whole.set("axes", std::move(axes));
    whole.set("swaps", std::move(swaps));
    whole.set("variants", std::move(variants));
    return whole.json();
}

}  // namespace voxray
