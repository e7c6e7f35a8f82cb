#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/config_options.h"
#include "base/error.h"
#include "base/lower_case.h"
#include "base/suggest.h"
#include "base/value.h"
#include "image/image.h"
#include "image/score.h"

namespace voxray {

namespace {

struct CompareOptions {
    std::filesystem::path test;
    std::filesystem::path reference;
    std::filesystem::path flipMap;
    std::string layer;
    float exposureStops = 0;
    std::vector<uint32_t> part;  ///< X, Y, width, height of what is compared; empty: all.
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
        const auto printRow = [&](const std::string& name, const char* end) {
            fmt::print("{:<10}", name);
            for (const Metric& metric : metrics()) {
                const auto score = row.scores.find(std::string(metric.name) + end);
                fmt::print(" {:>10}", score == row.scores.end() ? "" : fmt::format("{:.5g}", score->second));
            }
            fmt::print("\n");
        };
        printRow(row.name, "");
        if (row.name == "test" && row.scores.contains(metrics()[0].name + std::string(kLow))) {
            printRow("95 % low", kLow);
            printRow("95 % high", kHigh);
        }
    }
}

/// Prints scores as JSON. Numbers that are not finite (the PSNR of equal images) become null.
void printJson(const std::vector<Row>& rows, const CompareOptions& options, const FlipExposures& exposures) {
    const auto number = [](double value) {
        return std::isfinite(value) ? Value::fromScalar(fmt::format("{:.9g}", value)) : Value();
    };
    Value out = Value::map();
    out.set("test", Value::fromScalar(options.test.string(), true));
    out.set("reference", Value::fromScalar(options.reference.string(), true));
    for (const Row& row : rows) {
        Value scores = Value::map();
        for (const Metric& metric : metrics())
            for (const char* end : {"", kLow, kHigh})
                if (const auto score = row.scores.find(std::string(metric.name) + end); score != row.scores.end())
                    scores.set(score->first, number(score->second));
        out.set(row.name == "test" ? "scores" : row.name, std::move(scores));
    }
    Value range = Value::map();
    range.set("start", number(exposures.start));
    range.set("stop", number(exposures.stop));
    range.set("count", number(exposures.count));
    out.set("flip_exposures", std::move(range));
    out.set("exposure_stops", number(options.exposureStops));
    Value better = Value::map();
    for (const Metric& metric : metrics()) better.set(metric.name, Value::fromScalar(nameOf(metric.better), true));
    out.set("better", std::move(better));
    fmt::print("{}\n", out.json());
}

/// Reads the layer of that name, or the image of a file without layers.
LayeredImage readLayerOrOnly(const std::filesystem::path& path, const std::string& layer) {
    if (!layer.empty()) try {
            LayeredImage only = readLayer(path, "");
            if (only.layerCount <= 1 && only.layer.empty()) return only;
        } catch (const Error&) {
            // The file has several images: the layer is selected by its name
        }
    return readLayer(path, layer);
}

/// Reads an image, and prints the selected layer if there are several. @throws UsageError for an invalid
/// file.
LayeredImage readGiven(const std::filesystem::path& path, const std::string& layer) {
    try {
        LayeredImage read = readLayerOrOnly(path, layer);
        if (read.layerCount > 1 && !read.layer.empty())
            fmt::print(stderr, "voxray: {}: layer '{}' of {} is compared\n", path.string(), oneLine(read.layer),
                       read.layerCount);
        return read;
    } catch (const Error& error) {
        throw UsageError("{}", error.what());
    }
}

/// A part of an image, from its upper left; the image itself without a part. @throws UsageError if it isn't in the
/// image
ImageF partOf(ImageF image, const std::vector<uint32_t>& part) {
    if (part.empty()) return image;
    const uint64_t right = uint64_t(part[0]) + part[2], bottom = uint64_t(part[1]) + part[3];
    if (part[2] == 0 || part[3] == 0 || right > image.width || bottom > image.height)
        throw UsageError("--part: {} x {} pixels from ({}, {}) on are no part of an image of {} x {}", part[2], part[3],
                         part[0], part[1], image.width, image.height);
    ImageF cut(part[2], part[3], image.channels);
    for (uint32_t y = 0; y < cut.height; ++y)
        std::copy_n(image.pixel(part[0], part[1] + y), size_t(cut.width) * cut.channels, cut.pixel(0, y));
    return cut;
}

/// Reads the halves of a reference X.exr, X_a.exr and X_b.exr in the same folder, as `run` writes them; empty
/// if they don't exist. @throws Error if their mean isn't the reference.
std::vector<ImageF> readHalves(const std::filesystem::path& path, const ImageF& reference,
                               const std::vector<uint32_t>& part) {
    std::vector<ImageF> halves;
    std::vector<std::filesystem::path> paths;
    for (const char* end : {"_a", "_b"}) {
        paths.push_back(path.parent_path() / (path.stem().string() + end + path.extension().string()));
        if (!std::filesystem::exists(paths.back())) return {};
    }
    for (const std::filesystem::path& half : paths) halves.push_back(partOf(readGiven(half, "").image, part));
    double difference = 0, sum = 0;
    const bool fits =
        std::ranges::all_of(halves, [&](const ImageF& half) { return half.data.size() == reference.data.size(); });
    for (size_t i = 0; fits && i < reference.data.size(); ++i) {
        const double mean = 0.5 * (double(halves[0].data[i]) + double(halves[1].data[i]));
        difference += std::abs(mean - double(reference.data[i]));
        sum += std::abs(double(reference.data[i]));
    }
    if (!fits || difference > 1e-5 * sum)
        throw Error("{} isn't the mean of {} and {}, which are named like its halves: rename them", path.string(),
                    paths[0].filename().string(), paths[1].filename().string());
    return halves;
}

/// Whether a file has 8-bit values, as previews do.
bool isPreview(const std::filesystem::path& file) {
    const std::string end = lowerCase(file.extension().string());
    return end == ".png" || end == ".jpg" || end == ".jpeg";
}

void compare(const CompareOptions& options) {
    for (const std::filesystem::path& file : {options.test, options.reference})
        if (!std::filesystem::exists(file)) throw UsageError("no file '{}'{}", file.string(), didYouMeanFile(file));
    LayeredImage given = readGiven(options.test, options.layer);
    LayeredImage wanted = readGiven(options.reference, options.layer);
    if (!options.layer.empty() && given.layer.empty() && wanted.layer.empty())
        throw UsageError("--layer: neither file has layers");
    if (given.image.width != wanted.image.width || given.image.height != wanted.image.height)
        throw UsageError("{} is {}x{} and {} is {}x{}: images to compare are of one size", options.test.string(),
                         given.image.width, given.image.height, options.reference.string(), wanted.image.width,
                         wanted.image.height);
    const ImageF test = partOf(std::move(given.image), options.part);
    const ImageF reference = partOf(std::move(wanted.image), options.part);

    // All rows have the same exposures, which depend only on the reference
    ScoreOptions scoring;
    scoring.exposureStops = options.exposureStops;
    scoring.flipExposures = flipExposures(reference);
    const std::vector<ImageF> images = readHalves(options.reference, reference, options.part);
    std::optional<ReferenceHalves> halves;
    if (!images.empty()) halves.emplace(ReferenceHalves{images[0], images[1]});
    const Comparison comparison(test, reference, scoring, halves);
    std::vector<Row> rows = {{"test", score(comparison)},
                             {"black", score({blackLike(reference), reference, scoring, halves})},
                             {"constant", score({constantLike(reference), reference, scoring, halves})}};
    if (halves)
        rows.push_back({"noise", noiseFloors({halves->a, reference, scoring}, {halves->b, reference, scoring})});
    if (!options.flipMap.empty()) writePng(options.flipMap, comparison.flip.map);

    for (const std::filesystem::path& file : {options.test, options.reference})
        if (isPreview(file)) {
            fmt::print(stderr,
                       "voxray: warning: {}: it holds sRGB of 8 bits, clamped to [0, 1], "
                       "so that these are not the scores of results.csv: compare .exr files for those\n",
                       file.string());
            break;
        }
    if (options.json)
        printJson(rows, options, scoring.flipExposures);
    else
        printTable(rows);
}

}  // namespace

void addCompareCommand(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand(
        "compare", "Metrics of an image against a reference, with a black and a constant image's next to them.");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("TEST", options->test, "Image to compare (EXR, HDR, PNG, JPEG).")->required();
    command
        ->add_option("REFERENCE", options->reference,
                     "Image that is right. Where its halves stand next to it (final_a.exr, final_b.exr), "
                     "its noise is taken off nRMSE and relMSE, which then have 95 % confidence intervals.")
        ->required();
    command->add_flag("--json", options->json, "Print JSON.");
    command->add_option("--layer", options->layer,
                        "Layer of EXR files that have several, as in View.Combined, or its last word. "
                        "Without: plain R, G, B, else the one called Combined, Beauty, RGBA, RGB, Color or Final.");
    command
        ->add_option("--part", options->part,
                     "X,Y,WIDTH,HEIGHT: compare these pixels alone, counted from the upper left.")
        ->type_name("X,Y,WIDTH,HEIGHT")
        ->delimiter(',')
        ->expected(4);
    command->add_option("--flip-map", options->flipMap, "Write the HDR-FLIP error map to this PNG.")
        ->check(endsWith(".png"));
    command
        ->add_option("--exposure", options->exposureStops,
                     "Stops by which the previews are brightened before FLIP (LDR), SSIM and PSNR. Default 0.")
        ->check(CLI::Range(-32.0f, 32.0f));
    command->callback([options] { compare(*options); });
}

}  // namespace voxray
