#include "passes/common/light_paths/light_emission.h"

#include "passes/common/compute/dispatch.h"
#include "shaders/light_paths/light_path_types.h"

namespace voxray {
namespace {

struct EmitPush {
    gpu::EmittingSource source;
    uint32_t firstRay;
    uint32_t batchRays;
};

}  // namespace

void LightEmission::prepare(PassSetup& setup) {
    emit_ = makeComputeProgram(setup.device,
                               setup.compiler.compile("passes/common/light_paths/light_emission.comp"));
}

void LightEmission::emit(PassContext& context, const LightSource& source, const Batch& batch,
                         const Buffer& rays, const Buffer& paths) const {
    const BoundingSphere sphere = boundingSphere(context.frame.scene->geometry);
    const gpu::EmittingSource emitting{source.kind,   source.light, context.scene.emitterCount,
                                       batch.rays,    batch.seed,   sphere.center,
                                       sphere.radius, sphere.reach};
    context.stream.dispatch(emit_, context.scene.bindings({{"rays", rays}, {"paths", paths}}),
                            EmitPush{emitting, batch.first, batch.count}, linearGroups(batch.count));
}

}  // namespace voxray
