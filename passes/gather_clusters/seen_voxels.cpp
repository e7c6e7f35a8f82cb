#include "passes/gather_clusters/seen_voxels.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct MarkPush {
    gpu::VoxelGrid grid;
    glm::uvec2 texels;
};

struct SpreadPush {
    uint32_t first;
    uint32_t count;
};

uint64_t uints(uint64_t count) {
    return std::max<uint64_t>(count, 1) * sizeof(uint32_t);
}

}  // namespace

void SeenVoxels::plan(PassPlan& plan, uint64_t voxels) {
    plan.reserve("voxels that were seen (estimated)", uints(voxels));
    plan.reserveScratch("voxels that come into view (estimated)",
                        uints(voxels) + 2 * uints(kSidesPerVoxel * voxels) + uints(1));
}

void SeenVoxels::prepare(PassSetup& setup) {
    const auto program = [&](const char* name) {
        const std::string file = std::string("passes/gather_clusters/") + name + ".comp";
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    mark_ = program("mark");
    listSides_ = program("list_sides");
    spread_ = program("spread");
    sampler_ = texelSampler(setup.device);
}

void SeenVoxels::reset(PassContext& context, const SurfaceVoxels& voxels) {
    if (!asked_ || asked_.bytes() != uints(voxels.voxelCount)) {
        asked_ = {};
        asked_ = Buffer(context.device, "voxels that were seen", uints(voxels.voxelCount));
    }
    context.stream.fill(asked_, 0);
}

SeenVoxels::Found SeenVoxels::find(PassContext& context, const GBuffer& gbuffer, const SurfaceVoxels& voxels,
                                   const VoxelPatches& patches, uint32_t steps) const {
    CommandStream& stream = context.stream;
    Found found;
    found.voxels = Buffer(context.device, "voxels that come into view", uints(voxels.voxelCount));
    const Buffer count(context.device, "how many come into view", uints(1));
    const auto counted = [&] { return stream.readAs<uint32_t>(count, 1)[0]; };
    stream.fill(count, 0);
    const glm::uvec2 texels = gbufferExtent(context.frame, gbuffer.samples);
    stream.dispatch(mark_,
                    voxels.bindings({{"position", gbuffer.position, sampler_},
                                     {"asked", asked_},
                                     {"found", found.voxels},
                                     {"count", count}}),
                    MarkPush{voxels.grid, texels}, pixelGroups(texels.x, texels.y));
    found.voxelCount = counted();
    if (found.voxelCount == 0) return found;

    found.sides = Buffer(context.device, "sides that come into view", uints(patches.sideCount));
    const Buffer reached(context.device, "sides that were reached", uints(patches.sideCount));
    stream.fill(count, 0);
    stream.fill(reached, 0);
    stream.dispatch(listSides_,
                    {{"found", found.voxels},
                     {"firstSide", patches.firstSide},
                     {"sides", patches.sides},
                     {"reached", reached},
                     {"listed", found.sides},
                     {"count", count}},
                    found.voxelCount, linearGroups(found.voxelCount));
    found.sidesWithin = {counted()};
    uint32_t first = 0;
    for (uint32_t i = 0; i < steps; ++i) {
        const uint32_t end = found.sidesWithin.back();
        stream.dispatch(spread_,
                        {{"firstNeighbour", patches.firstNeighbour},
                         {"NeighboursAt", patches.neighbours.at()},
                         {"reached", reached},
                         {"listed", found.sides},
                         {"count", count}},
                        SpreadPush{first, end - first}, linearGroups(end - first));
        found.sidesWithin.push_back(counted());
        first = end;
    }
    return found;
}

}  // namespace voxray
