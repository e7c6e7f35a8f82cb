#pragma once

#include "graph/pass.h"
#include "passes/common/vpls/vpls.h"

namespace voxray {

/// A shadow map of each virtual point light of a run: what its hemisphere sees, by a ray a texel. What shadow
/// rays through voxels replace in Sun and Agu 2015.
class VplShadowMaps {
 public:
    /// @param resolution texels a side.
    void plan(PassPlan& plan, uint32_t resolution);
    void prepare(PassSetup& setup);
    /// Makes the maps of virtual lights [first, first + count) of the list, capacity() at most.
    void draw(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const;

    uint32_t resolution() const { return resolution_; }
    uint32_t capacity() const;
    const Buffer& hits() const { return hits_; }  ///< Hit each, by virtual light, row and column.

 private:
    uint32_t resolution_ = 0;
    Program aim_;
    Buffer rays_, hits_;
};

}  // namespace voxray
