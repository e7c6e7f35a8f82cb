#pragma once

#include <optional>

#include "passes/vpls/gather_vpls/vpl_shadow_maps.h"

namespace voxray {

/// Imperfect shadow maps (Ritschel et al. 2008), hemi-octahedral: points, uniformly distributed over all surfaces, are
/// splatted as discs along their triangles into many small maps at once. Adjacent maps use different points.
/// Holes are filled from coarser levels of the map (pull-push). The nearest disc wins by an atomic maximum of
/// inverse depth, so that the order of splats does not matter.
class ImperfectShadowMaps final : public VplShadowMaps {
 public:
    ImperfectShadowMaps(ProgramOwner& owner, uint32_t resolution, uint32_t pointsPerMap);
    void plan(PassPlan& plan) override;
    /// Samples the points again where surfaces have moved.
    void beginFrame(PassContext& context, const Vpls& vpls) override;
    void render(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const override;
    Defines defines() const override { return {{"SPLATTED", "1"}}; }
    std::vector<Binding> bindings() const override { return {{"maps", levels_[0]}}; }

 private:
    /// Levels of a map, each of half the resolution of the one before: more levels fill larger holes.
    static constexpr uint32_t kLevels = 5;
    uint32_t levelResolution(uint32_t level) const { return ((resolution() - 1) >> level) + 1; }

    const uint32_t pointsPerMap_;
    float area_ = 0;  ///< Of all surfaces, m².
    Kernel samplePoints_, splat_, pull_, push_;
    Buffer areaCdf_, pointSets_;
    Buffer levels_[kLevels];
    std::optional<uint64_t> sceneVersion_;  ///< Of the surfaces that the points were sampled on.
};

}  // namespace voxray
