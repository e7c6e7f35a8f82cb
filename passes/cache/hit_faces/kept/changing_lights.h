#pragma once

#include <cstdint>
#include <vector>

#include "graph/pass.h"
#include "passes/cache/hit_faces/point_batch.h"
#include "shaders/scene/scene_types.h"

namespace voxray {

/// Lights that points measure: those with a shadow ray of their own, of which a point knows whether it sees them, and
/// the others.
struct MeasuredLights {
    std::vector<LightSource> own, others;
    bool keepsLight = false;  ///< Of all lights that are not measured.
    uint32_t rays = 0;        ///< Of a point.
};

struct LightsOfPoints {
    MeasuredLights all;    ///< That shine.
    MeasuredLights again;  ///< Whose shadows may have moved.
};

/// Lights that change from frame to frame, while what they bring to points is kept: which ones have, what is known of
/// it without rays, and what rays have to measure.
class ChangingLights {
 public:
    explicit ChangingLights(ProgramOwner& owner);

    /// None has changed.
    void clear(const PassContext& context);
    /// Predicts the direct light of points by the lights that have changed since the frame before, and how far off that
    /// may be. @param ofPoints their places, hidden lights and direct light.
    void agePoints(PassContext& context, const PointBatch& batch, uint32_t faces, uint32_t pointsPerFace,
                   const std::vector<Binding>& ofPoints);
    /// What a point's light is measured by in this frame.
    LightsOfPoints toMeasure(const PointBatch& batch, const SceneState& scene) const;
    /// Words of a point that tell which lights are hidden from it: a bit for each.
    uint32_t hiddenWords() const;

 private:
    Kernel agePoints_;
    std::vector<gpu::GpuLight> lights_;  ///< Of the frame before.
    std::vector<bool> hasChanged_;       ///< By light: since clear().
};

}  // namespace voxray
