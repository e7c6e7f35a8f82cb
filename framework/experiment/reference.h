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

/// Total or indirect light of a reference: two independent halves and their mean, 3 channels each.
struct ReferenceLight {
    ImageF a, b, mean;
    ReferenceHalves halves() const { return {a, b}; }
};

/// The images that variants are compared with.
struct ReferenceImages {
    ReferenceLight final, indirect;
    double seconds = 0;  ///< Rendering time.
    bool cached = false;
    std::string hash;
};

/// The seed of the reference for variants with `seed`: another one, so that a path-traced variant does not
/// share the reference's samples. Seeds of configs are below 2^63, those of references are not.
uint64_t referenceSeed(uint64_t seed);

/// The outputs that a reference's pass must write.
std::vector<std::string> referencePorts();

/// Samples a pixel of a reference: the parameter 'spp' of its pass; 1 without one.
uint32_t referenceSamples(const Value& resolvedPass);

/// A rendered part of a reference, or the sum of several parts.
struct RenderedPart {
    ReferenceSums sums;
    double seconds = 0;    ///< Rendering time.
    bool isWhole = false;  ///< Has all samples, as returned by partOf(): no other part may be added.

    /// Adds another part of the same reference.
    void add(const RenderedPart& other);
};

/// Renders the samples that the target's frame selects. @param graph prepared, with a single pass that writes
/// ReferenceSums. @param frameIndex frames of a sequence use different random numbers, so that their noise is
/// independent. @param progress is called with the fraction done. @throws Interrupted; Error of the pass.
RenderedPart renderReference(Graph& graph, const GraphTarget& target, uint32_t frameIndex,
                             const std::function<void(double)>& progress);

/// The images of the sum of all parts. @throws Error if a half has no sample.
ReferenceImages imagesOf(const RenderedPart& whole);
/// A reference as a single part, for which imagesOf() returns the same bits.
RenderedPart partOf(const ReferenceImages& reference);

/// Key of a reference: the scene (SceneLoader::key), the resolved pass, image size and seed.
std::string referenceHash(const std::string& sceneKey, const Value& resolvedPass, const ImageSettings& image,
                          uint64_t seed);

/// Stores references in <folder>/<hash>/. Several processes may use the cache at once.
class ReferenceCache {
 public:
    explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// Whether there is a reference. load() may still fail because it is damaged.
    bool has(const std::string& hash) const;
    /// nullopt if it doesn't exist, is damaged or has another size; then it has to be rendered again.
    std::optional<ReferenceImages> load(const std::string& hash, uint32_t width, uint32_t height) const;
    /// @throws Error if it can't be written.
    void store(const ReferenceImages& reference) const;

 private:
    std::filesystem::path folder_;
};

/// Stores parts of references in a results folder: parts/<id>.sums, written atomically, for several processes
/// at once. A file has sums of samples in double, so that the image does not depend on the number of parts.
class ReferenceParts {
 public:
    static constexpr const char* kFolder = "parts";
    static constexpr const char* kEnding = ".sums";

    /// @param results the results folder.
    explicit ReferenceParts(const std::filesystem::path& results) : folder_(results / kFolder) {}

    /// "reference.0123456789ab.2-of-16": a prefix of the reference's hash and the number of the part.
    static std::string id(const std::string& hash, const SamplePart& part);

    /// Whether a part exists.
    bool has(const std::string& hash, const SamplePart& part) const;
    /// @throws Error if it can't be written.
    void store(const std::string& hash, const SamplePart& part, const RenderedPart& rendered) const;

    /// Whether all parts of a reference exist.
    bool isWhole(const std::string& hash) const { return completeParts(hash) > 0; }
    /// The sum of all parts of a reference, in their order, if isWhole(). A part that was copied from the
    /// cache has all samples.
    /// @throws Error for a part that is damaged, or of another reference or size.
    RenderedPart load(const std::string& hash, uint32_t width, uint32_t height) const;

 private:
    std::filesystem::path file(const std::string& hash, const SamplePart& part) const;
    /// The number of parts in the smallest complete set of parts; 0: there is none.
    uint32_t completeParts(const std::string& hash) const;

    std::filesystem::path folder_;
};

}  // namespace voxray
