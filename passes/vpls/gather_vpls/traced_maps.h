#pragma once

#include "passes/vpls/gather_vpls/vpl_maps.h"

namespace voxray {

/// Maps by a ray a texel: what shadow rays through voxels replace in Sun and Agu 2015.
class TracedMaps final : public VplMaps {
 public:
    TracedMaps(ProgramOwner& owner, uint32_t resolution);
    void plan(PassPlan& plan) override;
    void begin(PassContext&) override {}
    void draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const override;
    Defines defines() const override { return {}; }
    Binding binding() const override { return {"hits", hits_}; }

 private:
    Kernel aim_;
    Buffer rays_, hits_;  ///< By virtual light, row and column.
};

}  // namespace voxray
