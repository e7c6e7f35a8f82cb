#include "experiment/results_folder.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "config/sweep.h"
#include "experiment/reference.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kLock = ".lock";
constexpr const char* kManifest = "manifest.json";
constexpr const char* kRecordEnding = ".json";
constexpr const char* kParts = ReferenceParts::kFolder;

Json jsonOf(const PartRecord& record) {
    return {{"warnings", record.warnings},
            {"error", record.error},
            {"device", record.device},
            {"tracer", record.tracer},
            {"session", record.session}};
}

/// @throws nlohmann::json::exception.
PartRecord recordFrom(const Json& json) {
    const auto text = [&](const char* key) { return json.at(key).get<std::string>(); };
    return {json.at("warnings").get<std::vector<std::string>>(), text("error"), text("device"), text("tracer"),
            text("session")};
}

/// Replaces exceptions of the standard library by a Failure that says what to do.
template <typename Failure = Error, typename Work>
void orError(const fs::path& path, const Work& work) {
    try {
        work();
    } catch (const fs::filesystem_error& error) {
        const bool isFull = error.code() == std::errc::no_space_on_device;
        throw Failure("{}: {}; choose another folder with --out{}", path.string(), error.code().message(),
                      isFull ? " or make room" : "");
    }
}

/// The differing parts of two texts of maps or lists, from the first entry that differs to the last one, e.g.
/// "bounces: 2" and "bounces: 3" of longer graphs.
std::pair<std::string, std::string> differingParts(const std::string& a, const std::string& b) {
    const size_t shorter = std::min(a.size(), b.size());
    size_t same = size_t(std::mismatch(a.begin(), a.begin() + ptrdiff_t(shorter), b.begin()).first - a.begin());
    const size_t entry = same == 0 ? std::string::npos : a.find_last_of("{[,", same - 1);
    same = entry == std::string::npos ? 0 : a.find_first_not_of(' ', entry + 1);
    size_t end = 0;  // Number of equal characters at the end.
    while (end < shorter - same && a[a.size() - 1 - end] == b[b.size() - 1 - end]) ++end;
    const size_t next = a.find_first_of("}],", a.size() - end);
    end = next == std::string::npos ? 0 : a.size() - next;
    return {a.substr(same, a.size() - end - same), b.substr(same, b.size() - end - same)};
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path path, const std::string& experiment, FolderUse use, ProcessLock::IfHeld ifHeld)
    : path_(std::move(path)) {
    const bool isPart = use == FolderUse::Part;
    orError<UsageError>(path_, [&] {
        if (fs::exists(path_) && !fs::is_directory(path_)) throw UsageError("{}: is not a folder", path_.string());
        if (fs::exists(path_)) checkOwner(experiment);
        fs::create_directories(path_ / "images");
        lock_.emplace(path_ / kLock, isPart ? ProcessLock::Kind::Shared : ProcessLock::Kind::Exclusive, path_, ifHeld);
        checkOwner(experiment);  // Again, since another process may have used it before the lock.
    });
    if (isPart) return;
    const fs::path probe = ".writable";
    writeText(probe.string(), "x");
    orError(path_, [&] {
        fs::remove(path_ / probe);
        std::vector<fs::path> temporary;
        for (const fs::path& folder : {path_, path_ / kParts})
            if (fs::exists(folder))
                for (const auto& entry : fs::directory_iterator(folder))
                    if (isTemporaryName(entry.path()) || entry.path().extension() == kLock)
                        temporary.push_back(entry.path());  // Locks of parts that were killed are not in use.
        for (const fs::path& file : temporary) fs::remove(file);
        for (const auto& entry : fs::directory_iterator(path_ / "images"))
            if (entry.path().filename().string().starts_with(kTemporaryFolder)) fs::remove_all(entry.path());
        if (use == FolderUse::Fresh) replaced_ = removeOldRun();
    });
}

ProcessLock ResultsFolder::lockPart(const std::string& id, ProcessLock::IfHeld ifHeld) const {
    orError<UsageError>(path_, [&] { fs::create_directories(path_ / kParts); });
    return {path_ / kParts / ("." + id + ".lock"), ProcessLock::Kind::Exclusive, path_ / kParts / id, ifHeld};
}

void ResultsFolder::claim(const ManifestData& manifest) const {
    const fs::path file = path_ / kManifest;
    if (!fs::exists(file)) writeText(kManifest, manifestJson(manifest));
    // Another process may have written it at the same time
    const std::string text = readTextFile(file);
    if (identityIn(text) == identityOf(manifest)) return;
    const std::string what = manifestDifference(parseManifest(text), parseManifest(manifestJson(manifest)));
    if (!what.empty())
        throw UsageError("{}: holds parts of another experiment: {}; choose another folder with --out", path_.string(),
                         what);
}

void ResultsFolder::checkOwner(const std::string& experiment) const {
    const fs::path manifest = path_ / kManifest;
    if (fs::exists(manifest)) {
        const std::string name = experimentIn(readTextFile(manifest));
        if (name != experiment)
            throw UsageError("{}: holds the results of another experiment, '{}'; choose another folder with --out",
                             path_.string(), name);
        return;
    }
    for (const auto& entry : fs::directory_iterator(path_))
        if (const fs::path name = entry.path().filename();
            name != "images" && name != kLock && !isTemporaryName(entry.path()))
            throw UsageError("{}: is not empty and holds no results of Voxray; choose another folder with --out",
                             path_.string());
    if (fs::exists(path_ / "images") && !fs::is_empty(path_ / "images"))
        throw UsageError("{}: is not empty and holds no results of Voxray; choose another folder with --out",
                         path_.string());
}

size_t ResultsFolder::removeOldRun() const {
    for (const char* file : {"results.csv", "passes.csv", "values.csv", "frames.csv", "report.html"})
        fs::remove(path_ / file);
    fs::remove_all(path_ / kParts);
    removeReferences();
    size_t variants = 0;
    for (const auto& entry : fs::directory_iterator(path_ / "images")) {
        if (!fs::exists(entry.path() / "result.json")) continue;
        fs::remove_all(entry.path());
        ++variants;
    }
    return variants;
}

void ResultsFolder::removeReferences() const {
    for (const auto& entry : fs::directory_iterator(path_ / "images"))
        if (entry.path().filename().string().starts_with("reference")) fs::remove_all(entry.path());
}

std::optional<VariantResult> ResultsFolder::finished(const std::string& variant, const VariantInputs& inputs) const {
    const fs::path file = path_ / "images" / variant / "result.json";
    std::error_code code;
    if (!fs::exists(file, code)) return {};
    auto [result, oldInputs] = parseResultJson(readTextFile(file));
    if (oldInputs == inputs) return result;
    for (const auto& [name, text] : inputs)
        for (const auto& [oldName, oldText] : oldInputs)
            if (name == oldName && text != oldText) {
                const auto [before, now] = differingParts(oldText, text);
                throw UsageError(
                    "{}: holds another experiment: '{}' was run with another {} ({}, now {}); "
                    "choose another folder with --out or leave out --resume",
                    path_.string(), variant, name, before, now);
            }
    throw UsageError("{}: '{}' was run by another version of Voxray; leave out --resume", path_.string(), variant);
}

void ResultsFolder::writeImages(const std::string& name, const std::function<void(const fs::path&)>& write) const {
    const fs::path folder = path_ / "images" / name;
    orError(folder, [&] { writeFolderAtomically(folder, write); });
}

std::vector<ReferenceEntry> ResultsFolder::references() const {
    return referencesIn(path_ / "images");
}

void ResultsFolder::writeTables(const std::vector<VariantResult>& rows, const Experiment& experiment) const {
    const MeasureSettings& measure = experiment.measure;
    writeText("results.csv", resultsCsv(rows, sweepKeys(experiment), measure));
    writeText("passes.csv", passesCsv(rows));

    // Optional tables. Those of a resumed run are removed if this run has none
    const auto writeIf = [&](bool has, const char* name, const auto& text) {
        if (has)
            writeText(name, text());
        else
            fs::remove(path_ / name);
    };
    writeIf(std::ranges::any_of(rows, [](const VariantResult& r) { return !r.values.empty(); }), "values.csv",
            [&] { return valuesCsv(rows); });
    writeIf(measure.compareEvery > 0, "frames.csv", [&] { return framesCsv(rows, measure); });
}

void ResultsFolder::writeText(const std::string& name, const std::string& content) const {
    writeFileAtomically(path_ / name, content);
}

PartRecords::PartRecords(const fs::path& results) : folder_(results / kParts) {}

void PartRecords::store(const std::string& id, const PartRecord& record) const {
    const fs::path file = folder_ / (id + kRecordEnding);
    if (!record.warnings.empty() || !record.error.empty()) {
        fs::create_directories(folder_);
        const std::string text = jsonOf(record).dump(1, ' ', false, Json::error_handler_t::replace);
        writeFileAtomically(file, text + "\n");
        return;
    }
    std::error_code code;
    fs::remove(file, code);
    if (code) throw Error("{}: {}", file.string(), code.message());
}

std::map<std::string, PartRecord> PartRecords::load() const {
    std::map<std::string, PartRecord> records;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder_, code)) {
        if (entry.path().extension() != kRecordEnding || isTemporaryName(entry.path())) continue;
        try {
            records[entry.path().stem().string()] = recordFrom(Json::parse(readTextFile(entry.path())));
        } catch (const std::exception&) {
            continue;  // Records are optional.
        }
    }
    return records;
}

}  // namespace voxray
