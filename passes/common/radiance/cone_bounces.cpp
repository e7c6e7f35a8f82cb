#include "passes/common/radiance/cone_bounces.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPairs = 1u << 18;  // Bounds the time of a dispatch.

struct ListPush {
    gpu::VoxelGrid grid;
    uint32_t words;
};

struct GatherPush {
    gpu::VoxelGrid grid;
    uint32_t voxels;
    uint32_t firstPair;
    uint32_t pairs;
    uint32_t cones;
};

uint64_t coordinateBytes(uint64_t voxels) {
    return voxels * sizeof(glm::uvec3);
}

uint64_t fluxBytes(uint64_t voxels) {
    return voxels * kFluxWords * sizeof(uint32_t);
}

}  // namespace

void ConeBounces::plan(PassPlan& plan, uint64_t voxels, bool keeps) {
    plan.buffer(coneSet_, "cones", coneSet(cones_).size() * sizeof(gpu::Cone));
    const uint64_t light = coordinateBytes(voxels) + fluxBytes(voxels);
    if (keeps)
        plan.reserve("bounced light (estimated)", light);
    else
        plan.reserveScratch("bounced light (estimated)", light);
}

void ConeBounces::prepare(PassSetup& setup, const RadianceVoxels& radiance) {
    const auto program = [&](const char* file, const Defines& defines) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    list_ = program("passes/common/voxels/list_voxels.comp", {});
    gather_ = program("passes/common/radiance/cone_bounces_gather.comp", radiance.defines());
    setup.stream.upload(coneSet_, coneSet(cones_));
}

void ConeBounces::list(PassContext& context, const SurfaceVoxels& voxels) {
    const uint64_t count = voxels.voxelCount;
    if (!voxelCoordinates_ || voxelCoordinates_.bytes() != coordinateBytes(count)) {
        voxelCoordinates_ = {};
        voxelCoordinates_ = Buffer(context.device, "coordinates of surface voxels", coordinateBytes(count));
    }
    if (!flux_ || flux_.bytes() != fluxBytes(count)) {
        flux_ = {};
        flux_ = LargeBuffer(context.device, "bounced flux", fluxBytes(count));
    }
    context.stream.dispatch(list_, voxels.bindings({{"voxelCoordinates", voxelCoordinates_}}),
                            ListPush{voxels.grid, uint32_t(voxels.words())}, linearGroups(voxels.words()));
}

void ConeBounces::gather(PassContext& context, const SurfaceVoxels& voxels, const VoxelIrradiance& injected,
                         const RadianceVoxels& radiance) {
    list(context, voxels);
    std::vector<Binding> bindings = radiance.bindings();
    bindings.insert(bindings.end(), {{"cones", coneSet_},
                                     {"VoxelMaterialsAt", voxels.materials.at()},
                                     {"voxelCoordinates", voxelCoordinates_},
                                     {"DirectFluxAt", injected.direct.at()},
                                     {"IndirectFluxAt", injected.indirect.at()},
                                     {"voxelArea", injected.area},
                                     {"FluxAt", flux_.at()}});
    const uint32_t pairs = 3 * voxels.voxelCount;
    for (uint32_t first = 0; first < pairs; first += kBatchPairs) {
        const uint32_t batch = std::min(kBatchPairs, pairs - first);
        context.stream.dispatch(gather_, bindings,
                                GatherPush{voxels.grid, voxels.voxelCount, first, batch, cones_},
                                linearGroups(batch));
        context.stream.finish();
    }
}

void ConeBounces::release(CommandStream& stream) {
    stream.finish();
    voxelCoordinates_ = {};
    flux_ = {};
}

}  // namespace voxray
