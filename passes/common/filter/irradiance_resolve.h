#pragma once

#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Radiance that each pixel reflects of irradiance at the G-buffer's texels, by Lambert's law.
class IrradianceResolve {
 public:
    explicit IrradianceResolve(ProgramOwner& owner) : program_(owner, "irradiance_resolve.comp") {}

    /// Writes albedo / π times irradiance, averaged over each pixel's texels, W/(m² sr).
    /// @param irradiance RGBA32F of the G-buffer's extent, W/m². @param result a frame image.
    void record(PassContext& context, const GBuffer& gbuffer, const Image& irradiance, const Image& result) const {
        context.dispatch(program_, context.frame.pixels(), {gbuffer, {"irradiance", irradiance}, {"result", result}});
    }

 private:
    Kernel program_;
};

}  // namespace voxray
