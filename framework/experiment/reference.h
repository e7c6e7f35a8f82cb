#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/measure.h"
#include "image/image.h"
#include "image/score.h"

namespace voxray {

/// What variants are compared with. Variances are those of each pixel's mean.
struct ReferenceImages {
    ImageF final, indirect, variance, indirectVariance;  ///< 3 channels each.
    double seconds = 0;                                  ///< That rendering took, when it was rendered.
    bool cached = false;
    std::string hash;
};

/// Expected nrmse and relmse of a noisy image against its own expectation, from the variance of each pixel's
/// mean; both images have 3 channels. Empty where the pixels under the mask are black.
Scores noiseFloor(const ImageF& mean, const ImageF& variance, PixelMask mask = {});

/// The seed that the reference renders with: not the variants' own, so that a path-traced variant does not
/// share the reference's samples.
uint64_t referenceSeed(uint64_t seed);

/// The outputs that a reference's pass must write.
std::vector<std::string> referencePorts();

/// Renders a one-pass graph, prepared, that writes final, indirect, variance and indirect_variance.
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
