#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/lights/light_views.h"
#include "shaders/lights/rsm_types.h"

namespace voxray {

/// A reflective shadow map (Dachsbacher and Stamminger 2005) of one view at a time, with the visible points.
class RsmImage {
 public:
    explicit RsmImage(ProgramOwner& owner);

    /// @param resolution texels along an edge.
    void plan(PassPlan& plan, uint32_t resolution);
    void draw(PassContext& context, const gpu::LightView& view) const;
    /// RGBA32UI: triangle (Hit::kMiss: none), barycentrics as bits of floats, 0; as gpu::RsmTexel.
    const Image& image() const { return texels_; }

 private:
    Image texels_, depth_;
    RasterPipeline rasterize_;
};

/// Reflective shadow maps of all lights of a scene. GLSL: shaders/lights/rsm.glsl.
struct Rsm : Resource {
    uint32_t resolution = 0;           ///< Texels along an edge of a view; known from plan() on.
    std::vector<LightSource> sources;  ///< Point, spot and directional lights; known from plan() on.
    std::vector<uint32_t> firstView;   ///< By source, then the number of all views; known from plan() on.
    Buffer views;                      ///< gpu::RsmView each, in this frame.
    LargeBuffer texels;                ///< gpu::RsmTexel each, by view, row and column.

    std::vector<Elements> elements() const override {
        return {{&texels, Elements::Type::Uint32, sizeof(gpu::RsmTexel) / sizeof(uint32_t)}};
    }

    uint32_t texelsPerView() const { return resolution * resolution; }
    std::vector<Binding> bindings() const { return {{"rsmViews", views}, {"RsmTexelsRef", texels.ref()}}; }
};

}  // namespace voxray
