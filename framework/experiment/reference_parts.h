#pragma once

#include <filesystem>
#include <string>

#include "experiment/reference.h"

namespace voxray {

/// Parts of references in a results folder: parts/<id>.sums, each whole or absent, for many processes at
/// once. A file holds the sums themselves, so that all divisions of a reference add up to the same image.
class ReferenceParts {
 public:
    static constexpr const char* kFolder = "parts";
    static constexpr const char* kEnding = ".sums";

    /// @param results the results folder.
    explicit ReferenceParts(const std::filesystem::path& results) : folder_(results / kFolder) {}

    /// "reference.0123456789ab.2-of-16": the beginning of the reference's hash, and which part it is.
    static std::string id(const std::string& hash, const SamplePart& part);

    /// Whether there is a part, whole.
    bool has(const std::string& hash, const SamplePart& part) const;
    /// @throws Error where it can't be written.
    void store(const std::string& hash, const SamplePart& part, const RenderedPart& rendered) const;

    /// Whether all parts of a division are there.
    bool isWhole(const std::string& hash) const { return division(hash) > 0; }
    /// The sum of all parts, in their order, of a reference that isWhole(); or one that has all samples, for
    /// it came out of the cache.
    /// @throws Error for a part that is damaged, or of another reference or size.
    RenderedPart load(const std::string& hash, uint32_t width, uint32_t height) const;

 private:
    std::filesystem::path file(const std::string& hash, const SamplePart& part) const;
    /// How many parts the smallest division has that is whole; 0: none is.
    uint32_t division(const std::string& hash) const;

    std::filesystem::path folder_;
};

}  // namespace voxray
