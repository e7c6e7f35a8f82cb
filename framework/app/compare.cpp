#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "base/error.h"
#include "base/value.h"
#include "image/image.h"
#include "image/score.h"

namespace voxray {

namespace {

struct CompareOptions {
    std::filesystem::path test;
    std::filesystem::path reference;
    std::filesystem::path flipMap;
    float exposureStops = 0;
    bool json = false;
};

struct Row {
    std::string name;
    Scores scores;
};

void printTable(const std::vector<Row>& rows) {
    fmt::print("{:<10}", "");
    for (const Metric& metric : metrics()) fmt::print(" {:>10}", metric.name);
    fmt::print("\n");
    for (const Row& row : rows) {
        fmt::print("{:<10}", row.name);
        for (const Metric& metric : metrics()) fmt::print(" {:>10.5g}", row.scores.at(metric.name));
        fmt::print("\n");
    }
}

/// Numbers that JSON has no word for (the PSNR of equal images) become null.
void printJson(const std::vector<Row>& rows, const CompareOptions& options, const FlipExposures& exposures) {
    const auto number = [](double value) {
        return std::isfinite(value) ? Value::fromScalar(fmt::format("{:.9g}", value)) : Value();
    };
    Value out = Value::map();
    out.set("test", Value::fromScalar(options.test.string(), true));
    out.set("reference", Value::fromScalar(options.reference.string(), true));
    for (const Row& row : rows) {
        Value scores = Value::map();
        for (const Metric& metric : metrics()) scores.set(metric.name, number(row.scores.at(metric.name)));
        out.set(row.name == "test" ? "scores" : row.name, std::move(scores));
    }
    Value range = Value::map();
    range.set("start", number(exposures.start));
    range.set("stop", number(exposures.stop));
    range.set("count", number(exposures.count));
    out.set("flip_exposures", std::move(range));
    out.set("exposure_stops", number(options.exposureStops));
    fmt::print("{}\n", out.json());
}

void compare(const CompareOptions& options) {
    const ImageF test = readImage(options.test);
    const ImageF reference = readImage(options.reference);
    if (test.width != reference.width || test.height != reference.height)
        throw Error("{} is {}x{} and {} is {}x{}: images to compare are of one size", options.test.string(),
                    test.width, test.height, options.reference.string(), reference.width, reference.height);

    // The same exposures for all three rows, chosen from the reference alone.
    ScoreOptions scoring;
    scoring.exposureStops = options.exposureStops;
    scoring.flipExposures = flipExposures(reference);
    const Comparison comparison(test, reference, scoring);
    const std::vector<Row> rows = {{"test", score(comparison)},
                                   {"black", score({blackLike(reference), reference, scoring})},
                                   {"constant", score({constantLike(reference), reference, scoring})}};
    if (!options.flipMap.empty()) writePng(options.flipMap, comparison.flip.map);

    if (options.json)
        printJson(rows, options, scoring.flipExposures);
    else
        printTable(rows);
}

}  // namespace

void addCompareCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand(
        "compare",
        "Metrics of an image against a reference, with a black and a constant image's next to them.");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("TEST", options->test, "Image to compare (EXR, HDR, PNG, JPEG).")->required();
    command->add_option("REFERENCE", options->reference, "Image that is right.")->required();
    command->add_flag("--json", options->json, "Print JSON.");
    command->add_option("--flip-map", options->flipMap, "Write the HDR-FLIP error map to this PNG.");
    command
        ->add_option(
            "--exposure", options->exposureStops,
            "Stops by which the previews are brightened before FLIP (LDR), SSIM and PSNR. Default 0.")
        ->check(CLI::Range(-32.0f, 32.0f));
    command->callback([options] { compare(*options); });
}

}  // namespace voxray
