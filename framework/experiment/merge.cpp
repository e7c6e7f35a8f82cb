#include "experiment/merge.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "base/files.h"
#include "base/interrupt.h"
#include "config/yaml.h"
#include "experiment/manifest.h"
#include "experiment/reference.h"
#include "experiment/report_process.h"
#include "experiment/results_folder.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// An input folder of the merge.
struct Source {
    fs::path path;
    Json manifest;
    std::map<std::string, PartRecord> records;  ///< By the ids of parts.
};

/// @throws UsageError if a folder has no results, or results of another experiment than the first one.
std::vector<Source> readSources(const std::vector<fs::path>& folders) {
    std::vector<Source> sources;
    for (const fs::path& path : folders) {
        const fs::path file = path / "manifest.json";
        if (!fs::exists(file)) throw UsageError("{}: holds no results of Voxray", path.string());
        Source source{path, {}, PartRecords(path).load()};
        try {
            source.manifest = parseManifest(readTextFile(file));
        } catch (const Error& error) {
            throw UsageError("{}: {}", file.string(), error.what());
        }
        const std::string what = sources.empty() ? "" : manifestDifference(sources[0].manifest, source.manifest);
        if (!what.empty())
            throw UsageError("{} and {} can't be merged: {}", sources[0].path.string(), path.string(), what);
        sources.push_back(std::move(source));
    }
    return sources;
}

bool isSameFolder(const fs::path& a, const fs::path& b) {
    std::error_code code;
    return fs::equivalent(a, b, code);
}

/// @throws UsageError if the output folder has results of another run.
void checkTarget(const std::vector<Source>& sources, const fs::path& out) {
    const auto isOut = [&](const Source& source) { return isSameFolder(source.path, out); };
    if (fs::exists(out / "manifest.json") && std::ranges::none_of(sources, isOut))
        throw UsageError("{}: holds results already: choose another --out, or name it among the folders to merge",
                         out.string());
}

void copyImages(const fs::path& from, const ResultsFolder& target, const std::string& name) {
    target.writeImages(name, [&](const fs::path& to) {
        fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    });
}

/// Copies the references that the target lacks, with unique names.
void mergeReferences(const std::vector<Source>& sources, const ResultsFolder& target) {
    std::vector<ReferenceEntry> known = target.references();
    for (const Source& source : sources) {
        if (isSameFolder(source.path, target.path())) continue;
        for (const ReferenceEntry& reference : referencesIn(source.path / "images")) {
            if (std::ranges::count(known, reference.hash, &ReferenceEntry::hash) > 0) continue;
            std::string name = reference.folder;
            for (int number = 2; std::ranges::count(known, name, &ReferenceEntry::folder) > 0; ++number)
                name = fmt::format("reference.{}", number);
            copyImages(source.path / "images" / reference.folder, target, name);
            known.push_back({name, reference.hash, reference.text});
        }
    }
}

/// A finished variant.
struct Found {
    std::string name;
    const Source* from;
    VariantResult result;
};

/// Finds finished variants, in the experiment's order. @throws UsageError if two folders have the same
/// variant, or if its inputs aren't those of the experiment.
std::vector<Found> findVariants(const std::vector<Source>& sources, std::vector<std::string>& missing) {
    std::vector<Found> found;
    for (const auto& [name, keys] : sources[0].manifest["inputs"].items()) {
        const Source* from = nullptr;
        for (const Source& source : sources) {
            if (!fs::exists(source.path / "images" / name / "result.json")) continue;
            if (from && !isSameFolder(from->path, source.path))
                throw UsageError("{} and {} can't be merged: both hold '{}'", from->path.string(), source.path.string(),
                                 name);
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

/// A part that failed, and its record.
struct Failure {
    std::string part;
    const PartRecord* record;
};

/// The part whose failure is the reason that a variant has no result: its own or one of its reference.
/// @param hash that of its reference.
std::optional<Failure> failureOf(const std::string& name, const std::string& hash, const std::vector<Source>& sources) {
    const std::string whole = ReferenceParts::id(hash, {});
    const std::string reference = whole.substr(0, whole.rfind('.') + 1);
    std::optional<Failure> failure;
    for (const Source& source : sources) {
        if (const auto variant = source.records.find("variant." + name);
            variant != source.records.end() && !variant->second.error.empty())
            failure = {variant->first, &variant->second};
        auto record = source.records.lower_bound(reference);
        for (; !failure && record != source.records.end() && record->first.starts_with(reference); ++record)
            if (!record->second.error.empty()) failure = {record->first, &record->second};
    }
    return failure;
}

/// Rows of missing variants that failed. Removes them from `missing`, and copies their records to the target.
std::vector<VariantResult> failedRows(std::vector<std::string>& missing, const std::vector<Source>& sources,
                                      const ResultsFolder& target) {
    std::vector<VariantResult> rows;
    if (missing.empty()) return rows;
    const Json &inputs = sources[0].manifest["inputs"], &names = sources[0].manifest["names"];
    std::erase_if(missing, [&](const std::string& name) {
        const auto failure = failureOf(name, inputs.at(name).at("reference").get<std::string>(), sources);
        if (!failure) return false;
        const bool isVariant = failure->part.starts_with("variant.");
        const PartRecord& record = *failure->record;
        VariantResult row;
        row.variant = name;
        row.error = isVariant ? record.error : failure->part + ": " + record.error;
        row.name = names.at(name).get<std::string>();
        row.sweepValues = inputs.at(name).at("values").get<std::vector<std::string>>();
        const auto recordedOr = [&](const std::string& text, const char* key) {
            return isVariant ? text : sources[0].manifest.at(key).get<std::string>();
        };
        row.device = recordedOr(record.device, "device");
        row.tracer = recordedOr(record.tracer, "tracer");
        row.session = recordedOr(record.session, "started");
        rows.push_back(std::move(row));
        PartRecords(target.path()).store(failure->part, record);
        return true;
    });
    return rows;
}

/// Sorts rows into the experiment's order.
void sortRows(std::vector<VariantResult>& rows, const Json& inputs) {
    std::map<std::string, size_t> indices;
    for (const auto& [name, keys] : inputs.items()) indices.emplace(name, indices.size());
    std::ranges::sort(rows, {}, [&](const VariantResult& row) { return indices.at(row.variant); });
}

/// The union of a list of texts in all manifests.
std::vector<std::string> textsOf(const std::vector<Source>& sources, const char* key) {
    std::vector<std::string> texts;
    for (const Source& source : sources)
        for (const auto& text : source.manifest.at(key).get<std::vector<std::string>>())
            if (std::ranges::count(texts, text) == 0) texts.push_back(text);
    return texts;
}

/// The union of the warnings of all manifests and parts.
std::vector<std::string> warningsOf(const std::vector<Source>& sources) {
    std::vector<std::string> warnings = textsOf(sources, "warnings");
    std::set<std::string> known(warnings.begin(), warnings.end());
    for (const Source& source : sources)
        for (const auto& [part, record] : source.records)
            for (const std::string& text : record.warnings)
                if (known.insert(text).second) warnings.push_back(text);
    return warnings;
}

/// A warning if variants ran on different devices.
std::vector<std::string> differences(const std::vector<VariantResult>& rows) {
    std::set<std::string> devices;
    for (const VariantResult& row : rows) devices.insert(row.device + " with " + row.tracer);
    if (devices.size() < 2) return {};
    return {fmt::format("the variants ran on {}: compare times within one of them alone", fmt::join(devices, ", "))};
}

}  // namespace

RunSummary mergeResults(const std::vector<fs::path>& folders, const fs::path& out, const RunOptions& options) {
    std::vector<Source> sources = readSources(folders);
    checkTarget(sources, out);
    const Experiment experiment = readExperiment(parseYaml(sources[0].manifest.at("config").dump(), "manifest.json"));
    std::vector<std::string> missing;
    std::vector<Found> found = findVariants(sources, missing);

    // Everything was checked: write
    const ResultsFolder target(out, experiment.setup.general.name, FolderUse::Resume,
                               options.resume ? ProcessLock::IfHeld::Wait : ProcessLock::IfHeld::Refuse);
    std::vector<VariantResult> rows;
    for (Found& variant : found) {
        const fs::path& from = variant.from->path;
        if (!isSameFolder(from, out)) copyImages(from / "images" / variant.name, target, variant.name);
        rows.push_back(std::move(variant.result));
    }
    mergeReferences(sources, target);

    RunSummary summary;
    summary.out = out;
    summary.total = found.size() + missing.size();
    summary.ok = found.size();
    for (VariantResult& failed : failedRows(missing, sources, target)) {
        fmt::print(stderr, "voxray: warning: '{}' failed: {}\n", failed.name, failed.error);
        rows.push_back(std::move(failed));
        ++summary.failed;
    }
    summary.missing = missing.size();
    sortRows(rows, sources[0].manifest["inputs"]);

    std::vector<std::string> warnings = warningsOf(sources);
    for (const std::string& text : differences(rows)) {
        fmt::print(stderr, "voxray: warning: {}\n", text);
        if (std::ranges::count(warnings, text) == 0) warnings.push_back(text);
    }
    for (const std::string& name : missing) fmt::print(stderr, "voxray: warning: there is no result of '{}'\n", name);
    const std::vector<std::string> notes = textsOf(sources, "notes");
    target.writeText("manifest.json", mergedManifest(std::move(sources[0].manifest), target.references(),
                                                     sessionsOf(rows), warnings, notes, missing.empty()));
    target.writeTables(rows, experiment);

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
