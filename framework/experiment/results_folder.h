#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/process_lock.h"
#include "config/config.h"
#include "experiment/manifest.h"
#include "experiment/results.h"

namespace voxray {

/// How a results folder is used: by a run that replaces an older one, by a run that resumes it, or by a part
/// of a run, possibly while other processes do other parts.
enum class FolderUse { Fresh, Resume, Part };

/// The folder that a run writes into. All files are written atomically. The images of a variant and its
/// result.json appear at the same time, by renaming a folder.
class ResultsFolder {
 public:
    /// Makes the folder, locks it and checks that it can be written. Temporary files of a killed run are
    /// removed, except with FolderUse::Part, since they may be those of another part.
    /// @throws UsageError if another process writes into it (parts don't exclude each other), or if it
    /// contains anything but results of this experiment; Error if it can't be written.
    ResultsFolder(std::filesystem::path path, const std::string& experiment, FolderUse use,
                  ProcessLock::IfHeld ifHeld = ProcessLock::IfHeld::Refuse);

    const std::filesystem::path& path() const { return path_; }
    /// Number of finished variants of an older run that were removed for a fresh one.
    size_t replaced() const { return replaced_; }

    /// Prevents other processes from doing the same part while the lock exists. @throws UsageError if another
    /// process has the lock; Interrupted while waiting for it.
    ProcessLock lockPart(const std::string& id, ProcessLock::IfHeld ifHeld) const;

    /// Writes the manifest unless there is one, so that all parts in the folder belong to one experiment.
    /// @throws UsageError with the first difference to the existing manifest.
    void claim(const ManifestData& manifest) const;

    /// The result of a variant that an older run finished. @throws UsageError with the difference if it was
    /// run with other inputs.
    std::optional<VariantResult> finished(const std::string& variant, const VariantInputs& inputs) const;

    /// Writes images/<name>: `write` fills a temporary folder, which then replaces the old one.
    void writeImages(const std::string& name, const std::function<void(const std::filesystem::path&)>& write) const;

    /// The references whose images exist, in the order of their folders' names.
    std::vector<ReferenceEntry> references() const;

    /// Removes the images of all references.
    void removeReferences() const;

    /// Writes results.csv and the other tables, a row for each of these variants.
    void writeTables(const std::vector<VariantResult>& rows, const Experiment& experiment) const;

    /// Replaces a file of the folder.
    void writeText(const std::string& name, const std::string& content) const;

 private:
    void checkOwner(const std::string& experiment) const;
    /// @return the number of its finished variants.
    size_t removeOldRun() const;

    std::filesystem::path path_;
    size_t replaced_ = 0;
    std::optional<ProcessLock> lock_;
};

/// Information of a part, in addition to its result, for the merge.
struct PartRecord {
    std::vector<std::string> warnings;
    std::string error;  ///< Why it failed; "" if it did not.

    // Only for a variant that failed
    std::string device, tracer;
    std::string session;  ///< That of VariantResult.
};

/// Stores records of parts in a results folder: parts/<id>.json, written atomically. Parts without warnings
/// and errors have no file.
class PartRecords {
 public:
    /// @param results the results folder.
    explicit PartRecords(const std::filesystem::path& results);

    /// Replaces the record of an earlier attempt at this part. @throws Error if it can't be written.
    void store(const std::string& id, const PartRecord& record) const;
    /// All records by the ids of their parts. Incomplete files are skipped.
    std::map<std::string, PartRecord> load() const;

 private:
    std::filesystem::path folder_;
};

}  // namespace voxray
