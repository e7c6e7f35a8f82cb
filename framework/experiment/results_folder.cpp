#include "experiment/results_folder.h"

#include <nlohmann/json.hpp>

#include "base/files.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

constexpr const char* kTemporaryPrefix = ".tmp-";

// Turns the standard library's exceptions into one line that says what to do.
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

bool startsWith(const std::string& text, const char* prefix) {
    return text.rfind(prefix, 0) == 0;
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path path, const std::string& experiment, bool resume)
    : path_(std::move(path)) {
    orError<UsageError>(path_, [&] {
        if (fs::exists(path_) && !fs::is_directory(path_))
            throw UsageError("{}: is not a folder", path_.string());
        if (fs::exists(path_)) checkOwner(experiment);
        fs::create_directories(path_ / "images");
        lock_.emplace(path_);
        checkOwner(experiment);  // Again: another process may have had it until now.
    });
    const fs::path probe = ".writable";
    writeText(probe.string(), "x");
    orError(path_, [&] {
        fs::remove(path_ / probe);
        std::vector<fs::path> left;
        for (const auto& entry : fs::directory_iterator(path_))
            if (isTemporaryName(entry.path())) left.push_back(entry.path());
        for (const fs::path& file : left) fs::remove(file);
        for (const auto& entry : fs::directory_iterator(path_ / "images"))
            if (startsWith(entry.path().filename().string(), kTemporaryPrefix)) fs::remove_all(entry.path());
        if (!resume) removeOldRun();
    });
}

void ResultsFolder::checkOwner(const std::string& experiment) const {
    const fs::path manifest = path_ / "manifest.json";
    if (fs::exists(manifest)) {
        const auto json = nlohmann::json::parse(readTextFile(manifest), nullptr, false);
        const bool hasName = json.is_object() && json.contains("config") && json["config"].is_object() &&
                             json["config"].contains("name") && json["config"]["name"].is_string();
        const std::string name = hasName ? json["config"]["name"].get<std::string>() : std::string();
        if (name != experiment)
            throw UsageError(
                "{}: holds the results of another experiment, '{}'; choose another folder with --out",
                path_.string(), name);
        return;
    }
    for (const auto& entry : fs::directory_iterator(path_))
        if (const fs::path name = entry.path().filename();
            name != "images" && name != FolderLock::kFileName && !isTemporaryName(entry.path()))
            throw UsageError(
                "{}: is not empty and holds no results of Voxray; choose another folder with --out",
                path_.string());
    if (fs::exists(path_ / "images") && !fs::is_empty(path_ / "images"))
        throw UsageError("{}: is not empty and holds no results of Voxray; choose another folder with --out",
                         path_.string());
}

void ResultsFolder::removeOldRun() const {
    for (const char* file : {"results.csv", "passes.csv", "values.csv", "frames.csv", "report.html"})
        fs::remove(path_ / file);
    for (const auto& entry : fs::directory_iterator(path_ / "images"))
        if (fs::exists(entry.path() / "result.json") ||
            startsWith(entry.path().filename().string(), "reference"))
            fs::remove_all(entry.path());
}

std::optional<VariantResult> ResultsFolder::finished(const std::string& variant,
                                                     const VariantInputs& inputs) const {
    const fs::path file = path_ / "images" / variant / "result.json";
    std::error_code code;
    if (!fs::exists(file, code)) return {};
    auto [result, oldInputs] = parseResultJson(readTextFile(file));
    if (oldInputs == inputs) return result;
    for (const auto& [name, text] : inputs)
        for (const auto& [oldName, oldText] : oldInputs)
            if (name == oldName && text != oldText)
                throw UsageError(
                    "{}: holds another experiment: '{}' was run with another {} ({}, now {}); choose another "
                    "folder with --out or leave out --resume",
                    path_.string(), variant, name, oldText, text);
    throw UsageError("{}: '{}' was run by another version of Voxray; leave out --resume", path_.string(),
                     variant);
}

void ResultsFolder::writeImages(const std::string& name,
                                const std::function<void(const fs::path&)>& write) const {
    const fs::path folder = path_ / "images" / name;
    const fs::path temporary = path_ / "images" / (kTemporaryPrefix + name);
    try {
        orError(folder, [&] {
            fs::remove_all(temporary);
            fs::create_directories(temporary);
            write(temporary);
            fs::remove_all(folder);
            fs::rename(temporary, folder);
        });
    } catch (...) {
        std::error_code code;
        fs::remove_all(temporary, code);
        throw;
    }
}

void ResultsFolder::remove(const std::string& name) const {
    fs::remove(path_ / name);
}

void ResultsFolder::writeText(const std::string& name, const std::string& content) const {
    writeFileAtomically(path_ / name, content);
}

}  // namespace voxray
