#pragma once

#include "graph/pass.h"
#include "passes/common/lights/light_sources.h"

namespace voxray {

/// Starts rays at the lights, by shaders/light_paths/light_emission.glsl.
class LightEmission {
 public:
    void prepare(PassSetup& setup);

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
    Program emit_;
};

}  // namespace voxray
