#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "experiment/reference.h"
#include "experiment/session.h"
#include "image/score.h"

namespace voxray {

/// A reference that is rendered a sample a pixel at a time, so that its images can be looked at and compared with
/// before it is whole. Whole, they are bit for bit those that Session::reference() renders at once, for sums get the
/// same samples in the same order.
class ProgressiveReference {
 public:
    /// @param session must outlive this object.
    explicit ProgressiveReference(Session& session) : session_(session) {}

    /// Begins the reference of a study's only variant, which has one. If it is the same already, its samples are kept;
    /// if it is another one, they are freed. One that is cached is whole at once.
    void follow(const Study& study);
    /// As follow(), then renders until `budget` has passed, but at least a sample a pixel, or until it is whole. A
    /// whole one is stored in the cache.
    /// @throws Interrupted: whole samples are kept. Error of the pass: from then on the same one at once.
    void advance(const Study& study, std::optional<std::chrono::milliseconds> budget);

    /// Variant::referenceHash of its study; "" before follow().
    const std::string& hash() const { return hash_; }
    /// Samples a pixel so far, and of the whole reference.
    uint32_t samples() const { return samples_; }
    uint32_t of() const { return of_; }
    bool isWhole() const { return of_ > 0 && samples_ == of_; }
    bool hasFailed() const { return !failure_.empty(); }

    /// The images of all samples so far; nullptr while a half has none. Valid until advance() or follow().
    const ReferenceImages* images();
    /// The nRMSE that the images have by their own noise, by column.
    Scores noise();

 private:
    /// Adds a sample to each pixel.
    void addSample(const Study& study);
    /// The reference's graph, prepared on the scene of the device.
    Graph& graphOn(const SceneOnDevice& scene, const Study& study, const Frame& frame);

    Session& session_;
    std::string hash_, failure_;
    uint32_t samples_ = 0, of_ = 0;
    RenderedPart sum_;
    std::optional<ReferenceImages> images_;

    // Kept where the camera alone moves
    std::optional<Graph> graph_;
    std::string graphOf_;  ///< What it was prepared for.
};

}  // namespace voxray
