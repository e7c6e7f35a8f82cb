#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

/// A shader with all the files that it may include, read once. Internal to the vulkan layer.
namespace voxray {

/// Files are named relative to the source root, with '/' and without "..".
class ShaderSources {
 public:
    /// Reads `file` and, through every `#include "..."` in the text, all that it may include.
    /// Includes that are not found are left out: the compiler reports them if the preprocessor gets there.
    /// @throws Error where `file` itself can't be read.
    ShaderSources(std::filesystem::path sourceRoot, const std::string& file);

    /// Name and text of every file that was read.
    const std::map<std::string, std::string>& files() const { return files_; }

    /// The name of the file that `#include "header"` means in `includer`: next to the includer, else from the
    /// source root. Empty: there is none.
    std::optional<std::string> resolve(const std::string& header, const std::string& includer) const;

 private:
    void gather(const std::string& file);

    std::filesystem::path sourceRoot_;
    std::map<std::string, std::string> files_;
};

}  // namespace voxray
