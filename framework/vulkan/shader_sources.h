#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

/// A shader with all files that it may include, read once. Internal to the vulkan layer.
namespace voxray {

/// Files are named relative to the source root, with '/' and without "..".
class ShaderSources {
 public:
    /// Reads `file` and, recursively, all `#include "..."` in the text. Missing includes are skipped; the
    /// compiler reports them if the preprocessor gets there. @throws Error if `file` can't be read.
    /// @param text of `file` in place of what is on the disk; empty: none.
    ShaderSources(std::filesystem::path sourceRoot, const std::string& file, const std::string& text = {});

    /// Name and text of every file that was read.
    const std::map<std::string, std::string>& files() const { return files_; }

    /// The file of `#include "header"` in `includer`: relative to the includer, else to the source root.
    /// Empty if there is none.
    std::optional<std::string> resolve(const std::string& header, const std::string& includer) const;

 private:
    void gather(const std::string& file, std::string content);

    std::filesystem::path sourceRoot_;
    std::map<std::string, std::string> files_;
};

}  // namespace voxray
