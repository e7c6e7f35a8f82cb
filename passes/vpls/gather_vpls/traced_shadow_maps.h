#pragma once

#include "passes/vpls/gather_vpls/vpl_shadow_maps.h"

namespace voxray {

/// Hemi-octahedral shadow maps (hemi_octahedral.glsl) by one ray per texel.
class TracedShadowMaps final : public VplShadowMaps {
 public:
    TracedShadowMaps(ProgramOwner& owner, uint32_t resolution);
    void plan(PassPlan& plan) override;
    void beginFrame(PassContext&, const Vpls&) override {}
    void render(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const override;
    Defines defines() const override { return {}; }
    std::vector<Binding> bindings() const override { return {{"hits", hits_}}; }

 private:
    Kernel generateRays_;
    Buffer rays_, hits_;  ///< By virtual light, row and column.
};

}  // namespace voxray
