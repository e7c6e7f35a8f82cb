#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/measure.h"
#include "graph/reference_sums.h"
#include "image/image.h"
#include "image/score.h"

namespace voxray {

/// One light of a reference: two independent halves and their mean, 3 channels each.
struct ReferenceLight {
    ImageF a, b, mean;
    ReferenceHalves halves() const { return {a, b}; }
};

/// What variants are compared with.
struct ReferenceImages {
    ReferenceLight final, indirect;
    double seconds = 0;  ///< That rendering took, when it was rendered.
    bool cached = false;
    std::string hash;
};

/// The seed that the reference renders with: not the variants' own, so that a path-traced variant does not
/// share the reference's samples. Seeds of configs are below 2^63, those of references are not.
uint64_t referenceSeed(uint64_t seed);

/// The outputs that a reference's pass must write.
std::vector<std::string> referencePorts();

/// A part of a reference, or several parts together.
struct RenderedPart {
    ReferenceSums sums;
    double seconds = 0;    ///< That rendering took.
    bool isWhole = false;  ///< It has all samples already, as partOf() gives: no other part may be added.

    /// Adds another part of the same reference.
    void add(const RenderedPart& other);
};

/// Renders a one-pass graph, prepared, that writes ReferenceSums: of the samples that the target's frame asks
/// for. @param frameIndex of a sequence: frames draw random numbers of their own, so that their noise is
/// independent. @param progress called with the fraction done. @throws Interrupted; Error of the pass.
RenderedPart renderReference(Graph& graph, const GraphTarget& target, uint32_t frameIndex,
                             const std::function<void(double)>& progress);

/// The images of all parts together. @throws Error where a half has no sample.
ReferenceImages imagesOf(const RenderedPart& whole);
/// A reference as the only part of itself, of which imagesOf() gives the same bits again.
RenderedPart partOf(const ReferenceImages& reference);

/// Key of a reference: the scene (SceneLoader::key), the resolved pass, image size and seed.
std::string referenceHash(const std::string& sceneKey, const Value& resolvedPass, const ImageSettings& image,
                          uint64_t seed);

/// Keeps references under <folder>/<hash>/, each folder whole or absent, for many processes at once.
class ReferenceCache {
 public:
    explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// Whether there is a reference, which load() may yet find damaged.
    bool has(const std::string& hash) const;
    /// Empty where it isn't there, or is damaged or of another size: it is then rendered again.
    std::optional<ReferenceImages> load(const std::string& hash, uint32_t width, uint32_t height) const;
    /// @throws Error where it can't be written.
    void store(const ReferenceImages& reference) const;

 private:
    std::filesystem::path folder_;
};

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
