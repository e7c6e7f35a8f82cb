#include "passes/common/filter/irradiance_resolve.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/view/frame_image.h"

namespace voxray {

IrradianceResolve::IrradianceResolve(PassSetup& setup)
    : program_(makeComputeProgram(setup.device,
                                  setup.compiler.compile("passes/common/filter/irradiance_resolve.comp"))),
      sampler_(texelSampler(setup.device)) {}

void IrradianceResolve::record(PassContext& context, const GBuffer& gbuffer, const Image& irradiance,
                               const Image& result) const {
    context.stream.dispatch(
        program_,
        {{"irradiance", irradiance, sampler_}, {"albedo", gbuffer.albedo, sampler_}, {"result", result}},
        int32_t(gbuffer.samples), pixelGroups(context.frame.width, context.frame.height));
}

}  // namespace voxray
