#include "passes/cones/radiance/cone_bounces.h"

#include <algorithm>

namespace voxray {
namespace {

constexpr uint32_t kBatchPairs = 1u << 18;  // Bounds the time of a dispatch.

}  // namespace

ConeBounces::ConeBounces(ProgramOwner& owner, uint32_t cones)
    : cones_(cones),
      listVoxels_(owner, "passes/common/voxels/list_voxels.comp"),
      gather_(owner, "cone_bounces_gather.comp") {
    for (Kernel* kernel : {&listVoxels_, &gather_}) kernel->compileIf(false);
}

void ConeBounces::plan(PassPlan& plan, const RadianceVoxels& radiance) {
    for (Kernel* kernel : {&listVoxels_, &gather_}) kernel->compileIf(true);
    gather_.define(radiance.defines());
    plan.buffer(coneSet_, "cones", coneSet(cones_).size() * sizeof(gpu::Cone));
}

void ConeBounces::prepare(PassSetup& setup) {
    setup.stream.upload(coneSet_, coneSet(cones_));
}

void ConeBounces::listVoxels(PassContext& context, const SurfaceVoxels& voxels) {
    const uint64_t count = voxels.voxelCount;
    ensureSize(voxelCoordinates_, context.device, "coordinates of surface voxels", count * sizeof(glm::uvec3));
    ensureSize(flux_, context.device, "bounced flux", count * kFluxWords * sizeof(uint32_t));
    const uint32_t words = uint32_t(voxels.words());
    context.dispatch(listVoxels_, words, {voxels, {"voxelCoordinates", voxelCoordinates_}, {"words", words}});
}

void ConeBounces::gather(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& injected,
                         const RadianceVoxels& radiance) {
    listVoxels(context, voxels);
    const uint32_t pairs = 3 * voxels.voxelCount;
    for (uint32_t first = 0; first < pairs; first += kBatchPairs) {
        const uint32_t batch = std::min(kBatchPairs, pairs - first);
        context.dispatch(gather_, batch,
                         {voxels,
                          radiance,
                          {"cones", coneSet_},
                          {"voxelCoordinates", voxelCoordinates_},
                          {"DirectFluxRef", injected.direct.ref()},
                          {"IndirectFluxRef", injected.indirect.ref()},
                          {"voxelArea", injected.area},
                          {"FluxRef", flux_.ref()},
                          {"voxels", voxels.voxelCount},
                          {"firstPair", first},
                          {"pairs", batch},
                          {"coneCount", cones_}});
        context.stream.finish();
    }
}

void ConeBounces::release(CommandStream& stream) {
    stream.finish();
    voxelCoordinates_ = {};
    flux_ = {};
}

}  // namespace voxray
