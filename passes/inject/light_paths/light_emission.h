#pragma once

#include "graph/pass.h"
#include "passes/common/lights/light_sources.h"

namespace voxray {

/// Starts rays at the lights, by passes/inject/light_paths/light_emission.glsl. The sun's and the
/// environment's begin outside of all surfaces; where these reach far beyond the scene's region, outside of
/// those near it, and a ray back tells whether one farther out is in the way.
class LightEmission {
 public:
    explicit LightEmission(ProgramOwner& owner);

    /// @param rays the most of one batch.
    void plan(PassPlan& plan, uint64_t rays);

    /// Rays [first, first + count) of the `rays` that a source sends; those of one `seed` complement each
    /// other.
    struct Batch {
        uint32_t seed;  ///< Another one for each source.
        uint32_t rays;
        uint32_t first;
        uint32_t count;
    };
    /// Writes a batch. @param rays gets a Ray each. @param paths gets a gpu::LightPath each: what the ray
    /// carries.
    void emit(PassContext& context, const LightSource& source, const Batch& batch, const Buffer& rays,
              const Buffer& paths) const;

 private:
    /// Drops rays that surfaces beyond where they begin are in the way of.
    void dropOccluded(PassContext& context, float reach, uint32_t count, const Buffer& rays,
                      const Buffer& paths) const;

    bool reachesFar_ = false;  ///< Whether surfaces reach far beyond the region.
    Kernel emit_, turn_, drop_;
    Buffer backRays_, occluded_;  ///< Scratch, where they do.
};

}  // namespace voxray
