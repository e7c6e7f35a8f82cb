#include "passes/register_passes.h"

#include "passes/composite/composite.h"
#include "passes/direct_shadow_rays/direct_shadow_rays.h"
#include "passes/direct_voxels/direct_voxels.h"
#include "passes/gather_irradiance/gather_irradiance.h"
#include "passes/gbuffer/gbuffer_pass.h"
#include "passes/inject_light_rays/inject_light_rays.h"
#include "passes/inject_rsm/inject_rsm.h"
#include "passes/path_trace/path_trace_pass.h"
#include "passes/voxelize/voxelize_pass.h"

namespace voxray {

void registerPasses(Registry& registry) {
    registry.add<GBufferPass>();
    registry.add<VoxelizePass>();
    registry.add<InjectLightRays>();
    registry.add<InjectRsm>();
    registry.add<GatherIrradiance>();
    registry.add<DirectShadowRays>();
    registry.add<DirectVoxels>();
    registry.add<Composite>();
    registry.add<PathTracePass>();
}

}  // namespace voxray
