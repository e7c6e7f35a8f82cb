#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/lights/light_views.h"

namespace voxray {

/// A shadow map of one view at a time.
class ShadowMap {
 public:
    explicit ShadowMap(ProgramOwner& owner);

    /// @param resolution texels along an edge.
    void plan(PassPlan& plan, uint32_t resolution);
    /// Draws depth along the view's axis over view.farthest.
    void draw(PassContext& context, const gpu::LightView& view) const;
    const Image& image() const { return image_; }
    /// A sampler2D `shadowMap`.
    Binding binding() const { return {"shadowMap", image_}; }

 private:
    Image image_;
    RasterPipeline rasterize_;
};

/// Shadow maps of all punctual lights, for shaders that test all of them at once
/// (shaders/lights/shadow_maps.glsl).
class ShadowMaps {
 public:
    explicit ShadowMaps(ProgramOwner& owner) : map_(owner) {}

    /// @throws Error for more texels than 32 bits number.
    void plan(PassPlan& plan, const std::vector<LightSource>& sources, uint32_t resolution);
    /// Draws the maps of the lights in this frame.
    void draw(PassContext& context, const std::vector<LightSource>& sources);
    std::vector<Binding> bindings() const;

 private:
    uint32_t resolution_ = 0;
    ShadowMap map_;
    Buffer texels_;  ///< One map, before it is copied to `depths_`.
    Buffer lights_, views_;
    LargeBuffer depths_;
};

}  // namespace voxray
