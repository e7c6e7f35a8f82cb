#include "vulkan/shader_sources.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/files.h"

namespace voxray {
namespace {

constexpr int64_t kNanoseconds = 1'000'000'000;
/// Clocks of file systems advance by steps, at most as long as this.
constexpr int64_t kClockStep = 2 * kNanoseconds;

int64_t now() {
    const auto time = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
}

}  // namespace

std::optional<FileStamps::Stamp> FileStamps::of(const std::filesystem::path& path) {
    struct stat file;
    if (::stat(path.c_str(), &file) != 0) return std::nullopt;
    return Stamp{file.st_dev, file.st_ino, uint64_t(file.st_size),
                 file.st_mtim.tv_sec * kNanoseconds + file.st_mtim.tv_nsec};
}

void FileStamps::add(const std::filesystem::path& path) {
    const std::optional<Stamp> stamp = files_[path] = of(path);
    if (stamp) newest_ = std::max(newest_, stamp->nanoseconds);
    read_ = now();
}

bool FileStamps::areCurrent() const {
    if (files_.empty()) return true;
    return newest_ + kClockStep < read_ &&
           std::ranges::all_of(files_, [](const auto& file) { return of(file.first) == file.second; });
}

ShaderSources::ShaderSources(std::filesystem::path sourceRoot, const std::string& file, const std::string& text)
    : sourceRoot_(std::move(sourceRoot)) {
    const std::string name = std::filesystem::path(file).lexically_normal().generic_string();
    if (text.empty())
        gatherFile(name);
    else
        gather(name, text);
}

void ShaderSources::gatherFile(const std::string& file) {
    if (files_.contains(file)) return;
    stamps_.add(sourceRoot_ / file);
    gather(file, readTextFile(sourceRoot_ / file));
}

void ShaderSources::gather(const std::string& file, std::string content) {
    const std::string& text = files_[file] = std::move(content);
    // std::regex took 2 ms a kernel here, seven times as long
    for (size_t at = text.find('#'); at != std::string::npos; at = text.find('#', at + 1)) {
        const size_t word = text.find_first_not_of(" \t", at + 1);
        if (word == std::string::npos || text.compare(word, 7, "include") != 0) continue;
        const size_t quote = text.find_first_not_of(" \t", word + 7);
        if (quote == std::string::npos || text[quote] != '"') continue;
        const size_t end = text.find_first_of("\"\n", quote + 1);
        if (end == std::string::npos || text[end] != '"') continue;
        const std::string header = text.substr(quote + 1, end - quote - 1);
        const auto found = resolve(header, file);
        for (const std::string& candidate : candidates(header, file)) {
            if (candidate == found) break;
            stamps_.add(sourceRoot_ / candidate);
        }
        if (found) gatherFile(*found);
    }
}

std::array<std::string, 2> ShaderSources::candidates(const std::string& header, const std::string& includer) {
    const std::filesystem::path adjacent = std::filesystem::path(includer).parent_path() / header;
    return {adjacent.lexically_normal().generic_string(),
            std::filesystem::path(header).lexically_normal().generic_string()};
}

std::optional<std::string> ShaderSources::resolve(const std::string& header, const std::string& includer) const {
    for (const std::string& name : candidates(header, includer))
        if (files_.contains(name) || std::filesystem::is_regular_file(sourceRoot_ / name)) return name;
    return std::nullopt;
}

}  // namespace voxray
