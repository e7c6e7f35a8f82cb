#pragma once

#include "passes/common/view/gbuffer.h"

namespace voxray {

/// From irradiance at the G-buffer's texels to the radiance that each pixel reflects, by Lambert's law.
class IrradianceResolve {
 public:
    explicit IrradianceResolve(ProgramOwner& owner);

    /// Writes albedo / π times irradiance, averaged over each pixel's texels, W/(m² sr).
    /// @param irradiance RGBA32F of the G-buffer's extent, W/m². @param result a frame image.
    void record(PassContext& context, const GBuffer& gbuffer, const Image& irradiance,
                const Image& result) const;

 private:
    Kernel program_;
};

}  // namespace voxray
