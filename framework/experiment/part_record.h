#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace voxray {

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
