#include "experiment/merge.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/files.h"
#include "base/interrupt.h"
#include "config/yaml.h"
#include "experiment/manifest.h"
#include "experiment/report_process.h"
#include "experiment/results_folder.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// A results folder that is read.
struct Source {
    fs::path path;
    std::string text;  ///< Of its manifest.
    Json manifest;
};

/// @throws UsageError where a folder holds no results, or not those of the first one's experiment.
std::vector<Source> readSources(const std::vector<fs::path>& folders) {
    std::vector<Source> sources;
    for (const fs::path& path : folders) {
        const fs::path file = path / "manifest.json";
        if (!fs::exists(file)) throw UsageError("{}: holds no results of Voxray", path.string());
        Source source{path, readTextFile(file), {}};
        std::string what;
        try {
            what = manifestDifference(sources.empty() ? source.text : sources[0].text, source.text);
        } catch (const Error& error) {
            throw UsageError("{}: {}", file.string(), error.what());
        }
        if (!what.empty())
            throw UsageError("{} and {} can't be merged: {}", sources[0].path.string(), path.string(), what);
        source.manifest = Json::parse(source.text);
        sources.push_back(std::move(source));
    }
    return sources;
}

bool isSameFolder(const fs::path& a, const fs::path& b) {
    std::error_code code;
    return fs::equivalent(a, b, code);
}

/// Refuses a folder for the merged results that holds others.
void checkTarget(const std::vector<Source>& sources, const fs::path& out) {
    const auto isOut = [&](const Source& source) { return isSameFolder(source.path, out); };
    if (fs::exists(out / "manifest.json") && std::ranges::none_of(sources, isOut))
        throw UsageError(
            "{}: holds results already: choose another --out, or name it among the folders to merge",
            out.string());
}

void copyImages(const fs::path& from, const ResultsFolder& target, const std::string& name) {
    target.writeImages(name, [&](const fs::path& to) {
        fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    });
}

/// Takes over the references that the target lacks, each under a name of its own.
void mergeReferences(const std::vector<Source>& sources, const ResultsFolder& target) {
    for (const Source& source : sources) {
        if (isSameFolder(source.path, target.path())) continue;
        for (const ReferenceEntry& reference : referencesIn(source.path / "images")) {
            const std::vector<ReferenceEntry> known = target.references();
            if (std::ranges::count(known, reference.hash, &ReferenceEntry::hash) > 0) continue;
            std::string name = reference.folder;
            for (int number = 2; std::ranges::count(known, name, &ReferenceEntry::folder) > 0; ++number)
                name = fmt::format("reference.{}", number);
            copyImages(source.path / "images" / reference.folder, target, name);
        }
    }
}

/// A variant that is finished.
struct Found {
    std::string name;
    const Source* from;
    VariantResult result;
};

/// In the experiment's order. @throws UsageError where two folders hold a variant, or its inputs aren't those
/// of the experiment.
std::vector<Found> findVariants(const std::vector<Source>& sources, std::vector<std::string>& missing) {
    std::vector<Found> found;
    for (const auto& [name, keys] : sources[0].manifest["inputs"].items()) {
        const Source* from = nullptr;
        for (const Source& source : sources) {
            if (!fs::exists(source.path / "images" / name / "result.json")) continue;
            if (from && !isSameFolder(from->path, source.path))
                throw UsageError("{} and {} can't be merged: both hold '{}'", from->path.string(),
                                 source.path.string(), name);
            from = &source;
        }
        if (!from) {
            missing.push_back(name);
            continue;
        }
        auto [result, inputs] = parseResultJson(readTextFile(from->path / "images" / name / "result.json"));
        for (const auto& [input, text] : inputs)
            if (keys.contains(input) && keys.at(input).get<std::string>() != text)
                throw UsageError("{}: '{}' was run with another {}", from->path.string(), name, input);
        found.push_back({name, from, std::move(result)});
    }
    return found;
}

/// Texts of a list of all manifests, each once.
std::vector<std::string> textsOf(const std::vector<Source>& sources, const char* key) {
    std::vector<std::string> texts;
    for (const Source& source : sources)
        for (const auto& text : source.manifest.at(key).get<std::vector<std::string>>())
            if (std::ranges::count(texts, text) == 0) texts.push_back(text);
    return texts;
}

/// What to say of variants that ran on different machines.
std::vector<std::string> differences(const std::vector<VariantResult>& rows) {
    std::set<std::string> devices;
    for (const VariantResult& row : rows) devices.insert(row.device + " with " + row.tracer);
    if (devices.size() < 2) return {};
    return {fmt::format("the variants ran on {}: compare times within one of them alone",
                        fmt::join(devices, ", "))};
}

}  // namespace

RunSummary mergeResults(const std::vector<fs::path>& folders, const fs::path& out,
                        const RunOptions& options) {
    const std::vector<Source> sources = readSources(folders);
    checkTarget(sources, out);
    const Experiment experiment =
        readExperiment(parseYaml(sources[0].manifest.at("config").dump(), "manifest.json"));
    std::vector<std::string> missing;
    std::vector<Found> found = findVariants(sources, missing);

    // Nothing is written before all is known to fit
    const ResultsFolder target(out, experiment.setup.general.name, FolderUse::Resume);
    std::vector<VariantResult> rows;
    for (Found& variant : found) {
        const fs::path& from = variant.from->path;
        if (!isSameFolder(from, out)) copyImages(from / "images" / variant.name, target, variant.name);
        rows.push_back(std::move(variant.result));
    }
    mergeReferences(sources, target);

    std::vector<std::string> warnings = textsOf(sources, "warnings");
    for (const std::string& text : differences(rows)) {
        fmt::print(stderr, "voxray: warning: {}\n", text);
        if (std::ranges::count(warnings, text) == 0) warnings.push_back(text);
    }
    for (const std::string& name : missing)
        fmt::print(stderr, "voxray: warning: there is no result of '{}'\n", name);
    target.writeText("manifest.json", mergedManifest(sources[0].text, target.references(), sessionsOf(rows),
                                                     warnings, textsOf(sources, "notes"), missing.empty()));
    target.writeTables(rows, experiment);

    RunSummary summary;
    summary.out = out;
    summary.ok = rows.size();
    summary.missing = missing.size();
    summary.total = summary.ok + summary.missing;
    if (!options.report) return summary;
    try {
        makeReport(options.sourceRoot, target.path());
    } catch (const Error& error) {
        summary.reportError = error.what();
    }
    summary.interrupted = interruptRequested();
    return summary;
}

}  // namespace voxray
