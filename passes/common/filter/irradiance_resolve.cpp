#include "passes/common/filter/irradiance_resolve.h"

namespace voxray {

IrradianceResolve::IrradianceResolve(ProgramOwner& owner) : program_(owner, "irradiance_resolve.comp") {}

void IrradianceResolve::record(PassContext& context, const GBuffer& gbuffer, const Image& irradiance,
                               const Image& result) const {
    context.dispatch(program_, context.frame.pixels(),
                     {gbuffer, {"irradiance", irradiance}, {"result", result}});
}

}  // namespace voxray
