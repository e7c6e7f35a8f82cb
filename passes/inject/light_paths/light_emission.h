#pragma once

#include "graph/pass.h"
#include "passes/common/lights/light_sources.h"

namespace voxray {

/// Emits rays from lights (light_emission.glsl). Those of directional lights and of the environment begin
/// outside of all surfaces. Where surfaces extend far beyond the scene's region, they begin closer, and a ray
/// back to the light tests whether a surface occludes them.
class LightEmission {
 public:
    explicit LightEmission(ProgramOwner& owner);

    /// @param rays of a batch, at most.
    void plan(PassPlan& plan, uint64_t rays);

    /// Rays [first, first + count) of the `rays` of a source. Those of one seed are stratified.
    struct Batch {
        uint32_t seed;  ///< A different one for each source.
        uint32_t rays;
        uint32_t first;
        uint32_t count;
    };
    /// @param rays gets a Ray each. @param paths gets a gpu::LightPath each.
    void emit(PassContext& context, const LightSource& source, const Batch& batch, const Buffer& rays,
              const Buffer& paths) const;

 private:
    void dropOccluded(PassContext& context, float reach, uint32_t count, const Buffer& rays, const Buffer& paths) const;

    bool extendsFar_ = false;  ///< Whether surfaces extend far beyond the region.
    Kernel emit_, generateBackRays_, drop_;
    Buffer backRays_, occluded_;  ///< Scratch, where they do.
};

}  // namespace voxray
