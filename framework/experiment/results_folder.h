#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/folder_lock.h"
#include "experiment/results.h"

namespace voxray {

/// The folder that a run writes into. Every file in it appears whole or not at all; a variant's images appear
/// together with its result.json, by one rename.
class ResultsFolder {
 public:
    /// Makes the folder, locks it and checks that it can be written. An older run of the same experiment is
    /// kept for `resume`, else removed; what a killed run left half-written is removed.
    /// @throws UsageError where another process writes into it, or it holds anything but results of this
    /// experiment; Error where it can't be written.
    ResultsFolder(std::filesystem::path path, const std::string& experiment, bool resume);

    const std::filesystem::path& path() const { return path_; }

    /// A finished variant of an older run. @throws UsageError naming what differs where it was run with other
    /// inputs.
    std::optional<VariantResult> finished(const std::string& variant, const VariantInputs& inputs) const;

    /// Writes images/<name>: `write` fills a temporary folder, which then takes the old one's place.
    void writeImages(const std::string& name,
                     const std::function<void(const std::filesystem::path&)>& write) const;

    /// Replaces a file of the folder.
    void writeText(const std::string& name, const std::string& content) const;
    /// Removes a file if it is there.
    void remove(const std::string& name) const;

 private:
    void checkOwner(const std::string& experiment) const;
    void removeOldRun() const;

    std::filesystem::path path_;
    std::optional<FolderLock> lock_;
};

}  // namespace voxray
