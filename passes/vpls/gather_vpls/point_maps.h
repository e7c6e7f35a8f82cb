#pragma once

#include <optional>

#include "passes/vpls/gather_vpls/vpl_maps.h"

namespace voxray {

/// Imperfect shadow maps (Ritschel et al. 2008): points spread over all surfaces by area, each a disc that
/// faces as its triangle does, are splatted into many small maps at once, other points into the map next to
/// it, and holes between them are filled from coarser levels of the map (pull-push). The nearest disc wins
/// by an atomic maximum of inverse depth, so that the order of splats does not show.
class PointMaps final : public VplMaps {
 public:
    /// @param points of each map.
    PointMaps(ProgramOwner& owner, uint32_t resolution, uint32_t points);
    void plan(PassPlan& plan) override;
    /// Spreads the points, again where surfaces have moved.
    void begin(PassContext& context) override;
    void draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const override;
    Defines defines() const override { return {{"POINTS", "1"}}; }
    Binding binding() const override { return {"maps", levels_[0]}; }

 private:
    /// Levels of a map, of half as many texels a side each: holes of that many times two texels are filled.
    static constexpr uint32_t kLevels = 5;
    uint32_t side(uint32_t level) const { return ((resolution() - 1) >> level) + 1; }

    const uint32_t points_;
    float area_ = 0;  ///< Of all surfaces, m².
    Kernel spread_, splat_, pull_, push_;
    Buffer upTo_, spreadPoints_;
    Buffer levels_[kLevels];
    std::optional<uint64_t> version_;  ///< Of the scene that points are spread over.
};

}  // namespace voxray
