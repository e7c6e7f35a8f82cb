#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/measure.h"
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

/// Renders a one-pass graph, prepared, that writes the halves final_a, final_b, indirect_a and indirect_b.
/// @param frameIndex of a sequence: frames draw random numbers of their own, so that their noise is
/// independent. @param progress called with the fraction done. @throws Interrupted; Error of the pass.
ReferenceImages renderReference(Graph& graph, const GraphTarget& target, uint32_t frameIndex,
                                const std::function<void(double)>& progress);

/// Key of a reference: the scene (SceneLoader::key), the resolved pass, image size and seed.
std::string referenceHash(const std::string& sceneKey, const Value& resolvedPass, const ImageSettings& image,
                          uint64_t seed);

/// Keeps references under <folder>/<hash>/, each folder whole or absent.
class ReferenceCache {
 public:
    explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// Empty where it isn't there, or is damaged or of another size: it is then rendered again.
    std::optional<ReferenceImages> load(const std::string& hash, uint32_t width, uint32_t height) const;
    /// @throws Error where it can't be written.
    void store(const ReferenceImages& reference) const;

 private:
    std::filesystem::path folder_;
};

}  // namespace voxray
