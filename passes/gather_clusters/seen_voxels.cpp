#include "passes/gather_clusters/seen_voxels.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/uints.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct MarkPush {
    gpu::VoxelGrid grid;
    glm::uvec2 texels;
    int32_t reach;
};

struct SpreadSeenPush {
    uint32_t first;
    uint32_t count;
};

}  // namespace

void SeenVoxels::plan(PassPlan& plan, uint64_t voxels) {
    plan.reserve("voxels that come into view (estimated)",
                 2 * uints(voxels) + 2 * uints(kSidesPerVoxel * voxels) + uints(1));
    if (byPoints_) points_.plan(plan);
}

void SeenVoxels::prepare(PassSetup& setup) {
    const auto program = [&](const char* name) {
        const std::string file = std::string("passes/gather_clusters/") + name + ".comp";
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    if (byPoints_)
        points_.prepare(setup);
    else
        mark_ = program("mark");
    listSides_ = program("list_sides");
    spread_ = program("spread");
    sampler_ = texelSampler(setup.device);
}

void SeenVoxels::reset(PassContext& context, const SurfaceVoxels& voxels, const VoxelPatches& patches) {
    const auto make = [&](Buffer& buffer, const char* name, uint64_t count) {
        makeOrKeep(buffer, context.device, name, uints(count));
    };
    make(asked_, "voxels that were seen", voxels.voxelCount);
    make(found_, "voxels that come into view", voxels.voxelCount);
    make(listed_, "sides that come into view", patches.sideCount);
    make(reached_, "sides that were reached", patches.sideCount);
    make(count_, "how many come into view", 1);
    context.stream.fill(asked_, 0);
}

void SeenVoxels::mark(PassContext& context, const GBuffer& gbuffer, const SurfaceVoxels& voxels,
                      uint32_t reach) const {
    const glm::uvec2 texels = gbufferExtent(context.frame, gbuffer.samples);
    context.stream.dispatch(mark_,
                            voxels.bindings({{"position", gbuffer.position, sampler_},
                                             {"asked", asked_},
                                             {"found", found_},
                                             {"count", count_}}),
                            MarkPush{voxels.grid, texels, int32_t(reach)}, pixelGroups(texels.x, texels.y));
}

SeenVoxels::Found SeenVoxels::find(PassContext& context, const GBuffer* gbuffer, const SurfaceVoxels& voxels,
                                   const VoxelClusters& clusters, const VoxelPatches& patches, uint32_t reach,
                                   uint32_t steps) const {
    CommandStream& stream = context.stream;
    Found found;
    const auto counted = [&] { return stream.readAs<uint32_t>(count_, 1)[0]; };
    stream.fill(count_, 0);
    if (byPoints_)
        points_.mark(context, voxels, clusters.coordinates, asked_, found_, count_);
    else
        mark(context, *gbuffer, voxels, reach);
    found.voxelCount = counted();
    if (found.voxelCount == 0) return found;

    stream.fill(count_, 0);
    stream.fill(reached_, 0);
    stream.dispatch(listSides_,
                    {{"found", found_},
                     {"firstSide", patches.firstSide},
                     {"sides", patches.sides},
                     {"reached", reached_},
                     {"listed", listed_},
                     {"count", count_}},
                    found.voxelCount, linearGroups(found.voxelCount));
    found.sidesWithin = {counted()};
    uint32_t first = 0;
    for (uint32_t i = 0; i < steps; ++i) {
        const uint32_t end = found.sidesWithin.back();
        stream.dispatch(spread_,
                        {{"firstNeighbour", patches.firstNeighbour},
                         {"NeighboursAt", patches.neighbours.at()},
                         {"reached", reached_},
                         {"listed", listed_},
                         {"count", count_}},
                        SpreadSeenPush{first, end - first}, linearGroups(end - first));
        found.sidesWithin.push_back(counted());
        first = end;
    }
    return found;
}

}  // namespace voxray
