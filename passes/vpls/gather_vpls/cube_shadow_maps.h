#pragma once

#include <vector>

#include "passes/common/lights/shadow_map.h"
#include "passes/vpls/gather_vpls/vpl_shadow_maps.h"

namespace voxray {

/// Cube shadow maps by rasterization: the scene is drawn once for each face of each virtual light's cube. Faces
/// that lie behind the light's surface are left out.
class CubeShadowMaps final : public VplShadowMaps {
 public:
    CubeShadowMaps(ProgramOwner& owner, uint32_t resolution);
    void plan(PassPlan& plan) override;
    /// Reads the lights back, since a draw's view is a push constant.
    void beginFrame(PassContext& context, const Vpls& vpls) override;
    void render(PassContext& context, const Vpls& vpls, uint32_t first, uint32_t count) const override;
    Defines defines() const override { return {{"CUBES", "1"}}; }
    std::vector<Binding> bindings() const override { return {{"views", views_}, {"maps", depths_}}; }

 private:
    static constexpr uint32_t kFaces = 6;
    uint64_t faceBytes() const { return uint64_t(resolution()) * resolution() * sizeof(float); }

    ShadowMap face_;
    Buffer faceDepths_;  ///< Of one face, before they are copied to `depths_`.
    Buffer views_, depths_;
    std::vector<gpu::Vpl> active_;  ///< The lights of this frame, in the order of Vpls::activeIndices.
};

}  // namespace voxray
