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

/// Who writes into a results folder: a whole run in place of an older one, one that goes on with it, or a
/// part of a run, next to others in other processes.
enum class FolderUse { Fresh, Resume, Part };

/// The folder that a run writes into. Every file in it appears whole or not at all; a variant's images appear
/// together with its result.json, by one rename.
class ResultsFolder {
 public:
    /// Makes the folder, locks it and checks that it can be written. What a killed run left half-written is
    /// removed, but by parts: it may be another one's.
    /// @throws UsageError where another process writes into it (parts don't exclude each other), or it holds
    /// anything but results of this experiment; Error where it can't be written.
    ResultsFolder(std::filesystem::path path, const std::string& experiment, FolderUse use,
                  ProcessLock::IfHeld ifHeld = ProcessLock::IfHeld::Refuse);

    const std::filesystem::path& path() const { return path_; }
    /// How many finished variants of an older run were removed for a fresh one.
    size_t replaced() const { return replaced_; }

    /// Keeps other processes from the same part while the lock lives. @throws UsageError where one has it;
    /// to wait: Interrupted.
    ProcessLock lockPart(const std::string& id, ProcessLock::IfHeld ifHeld) const;

    /// Writes the manifest where there is none, so that all parts of a folder are of one experiment.
    /// @throws UsageError that tells what differs from the one that is there.
    void claim(const ManifestData& manifest) const;

    /// A finished variant of an older run. @throws UsageError naming what differs where it was run with other
    /// inputs.
    std::optional<VariantResult> finished(const std::string& variant, const VariantInputs& inputs) const;

    /// Writes images/<name>: `write` fills a temporary folder, which then takes the old one's place.
    void writeImages(const std::string& name,
                     const std::function<void(const std::filesystem::path&)>& write) const;

    /// The references whose images are there, in the order of their folders' names.
    std::vector<ReferenceEntry> references() const;

    /// Removes the images of all references.
    void removeReferences() const;

    /// Writes results.csv and the other tables, a row for each of these variants.
    void writeTables(const std::vector<VariantResult>& rows, const Experiment& experiment) const;

    /// Replaces a file of the folder.
    void writeText(const std::string& name, const std::string& content) const;

 private:
    void checkOwner(const std::string& experiment) const;
    /// @return how many finished variants it had.
    size_t removeOldRun() const;

    std::filesystem::path path_;
    size_t replaced_ = 0;
    std::optional<ProcessLock> lock_;
};

/// What a part has to tell besides its result, for the merge.
struct PartRecord {
    std::vector<std::string> warnings;
    std::string error;  ///< Why it failed, "" where it did not.

    // Of a variant that failed
    std::string device, tracer;
    std::string session;  ///< As in VariantResult.
};

/// Records of parts in a results folder: parts/<id>.json, each whole or absent, and absent where there is
/// nothing to tell.
class PartRecords {
 public:
    /// @param results the results folder.
    explicit PartRecords(const std::filesystem::path& results);

    /// Replaces the record that an earlier try at this part left. @throws Error where it can't be written.
    void store(const std::string& id, const PartRecord& record) const;
    /// All records by the ids of their parts. What isn't whole, or was removed just now, is left out.
    std::map<std::string, PartRecord> load() const;

 private:
    std::filesystem::path folder_;
};

}  // namespace voxray
