#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

/// A shader with all files that it may include, read once. Internal to the vulkan layer.
namespace voxray {

/// Tells whether files have changed since they were read.
class FileStamps {
 public:
    /// Remembers a file as it is now, or that it is missing. Called before it is read.
    void add(const std::filesystem::path& path);
    /// Whether all files are as they were. False for a while after a file was written: another change may get the same
    /// time.
    bool areCurrent() const;

 private:
    struct Stamp {
        uint64_t device, inode, bytes;
        int64_t nanoseconds;  ///< Of the last change, since 1970.
        bool operator==(const Stamp&) const = default;
    };
    static std::optional<Stamp> of(const std::filesystem::path& path);

    std::map<std::filesystem::path, std::optional<Stamp>> files_;  ///< nullopt: missing.
    int64_t newest_ = 0;                                           ///< Largest Stamp::nanoseconds.
    int64_t read_ = 0;                                             ///< When the last file was added.
};

/// Files are named relative to the source root, with '/' and without "..".
class ShaderSources {
 public:
    /// Reads `file` and, recursively, all `#include "..."` in the text. Missing includes are skipped; the
    /// compiler reports them if the preprocessor gets there. @throws Error if `file` can't be read.
    /// @param text of `file` in place of what is on the disk; empty: none.
    ShaderSources(std::filesystem::path sourceRoot, const std::string& file, const std::string& text = {});

    /// Name and text of every file that was read.
    const std::map<std::string, std::string>& files() const { return files_; }
    /// Of all files, and of those that would be included if they existed.
    const FileStamps& stamps() const { return stamps_; }

    /// The file of `#include "header"` in `includer`: relative to the includer, else to the source root.
    /// Empty if there is none.
    std::optional<std::string> resolve(const std::string& header, const std::string& includer) const;

 private:
    void gatherFile(const std::string& file);
    void gather(const std::string& file, std::string content);
    static std::array<std::string, 2> candidates(const std::string& header, const std::string& includer);

    std::filesystem::path sourceRoot_;
    std::map<std::string, std::string> files_;
    FileStamps stamps_;
};

}  // namespace voxray
