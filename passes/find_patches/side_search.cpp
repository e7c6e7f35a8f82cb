#include "passes/find_patches/side_search.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/uints.h"
#include "trace/ray.h"

namespace voxray {
namespace {

/// Of a voxel, open or covered: what is left is on the last one.
constexpr uint32_t kMaxPatchSides = 8;

struct AcrossPush {
    uint32_t first;
    uint32_t count;
    float voxelSize;
};

struct PivotPush {
    uint32_t voxels;
    uint32_t round;
    uint32_t isCovered;
};

struct SideAimPush {
    uint32_t first;
    uint32_t count;
    uint32_t isCovered;
};

struct JoinPush {
    uint32_t first;
    uint32_t count;
    uint32_t round;
    uint32_t isLast;
    uint32_t isCovered;
};

struct RaisePush {
    uint32_t first;
    uint32_t count;
};

}  // namespace

void RayBatch::plan(MemoryPlan& plan, bool meetSurfaces) {
    plan.scratchBuffer(rays, "rays between surfels", uint64_t(kRays) * sizeof(Ray));
    plan.scratchBuffer(occluded, "visibility of surfels", uint64_t(kRays) * sizeof(uint32_t));
    if (meetSurfaces) plan.scratchBuffer(hits, "gaps before surfels", uint64_t(kRays) * sizeof(Hit));
}

SideSearch::SideSearch(Device& device, const ShaderCompiler& compiler) {
    const auto program = [&](const char* name) {
        const std::string file = std::string("passes/find_patches/") + name + ".comp";
        return makeComputeProgram(device, compiler.compile(file));
    };
    aimAcross_ = program("aim_across");
    raise_ = program("raise");
    pivot_ = program("pivot");
    aim_ = program("aim");
    join_ = program("join");
}

void SideSearch::find(PassContext& context, const RayBatch& batch, const SurfaceVoxels& voxels,
                      bool coveredSides, const SurfelsByVoxel& lists, const VoxelPatches& patches) const {
    splitByRays(context, batch, voxels.voxelCount, lists, patches, 0);
    if (!coveredSides) return;
    raiseCovered(context, batch, voxels.grid.voxelSize, patches);
    splitByRays(context, batch, voxels.voxelCount, lists, patches, 1);
}

void SideSearch::raiseCovered(PassContext& context, const RayBatch& batch, float voxelSize,
                              const VoxelPatches& patches) const {
    CommandStream& stream = context.stream;
    RayBatch::inBatches(patches.surfelCount, [&](uint32_t first, uint32_t count) {
        stream.dispatch(
            aimAcross_,
            context.scene.bindings({{"rays", batch.rays}, {"PatchSurfelsAt", patches.surfels.at()}}),
            AcrossPush{first, count, voxelSize}, linearGroups(count));
        context.tracer.closestHit(stream, batch.rays, batch.hits, count);
        stream.dispatch(raise_, {{"hits", batch.hits}, {"PatchSurfelsAt", patches.surfels.at()}},
                        RaisePush{first, count}, linearGroups(count));
    });
}

void SideSearch::splitByRays(PassContext& context, const RayBatch& batch, uint32_t voxels,
                             const SurfelsByVoxel& lists, const VoxelPatches& patches,
                             uint32_t isCovered) const {
    CommandStream& stream = context.stream;
    const Buffer pivots(context.device, "surfels that began sides", uints(voxels));
    const Buffer left(context.device, "voxels with surfels on no side", uints(1));
    for (uint32_t i = 0; i < kMaxPatchSides; ++i) {
        const uint32_t round = isCovered * kMaxPatchSides + i;
        stream.fill(left, 0);
        stream.dispatch(pivot_,
                        {{"lists", lists.lists},
                         {"pivots", pivots},
                         {"left", left},
                         {"PatchSurfelsAt", patches.surfels.at()}},
                        PivotPush{voxels, round, isCovered}, linearGroups(voxels));
        if (stream.readAs<uint32_t>(left, 1)[0] == 0) break;
        RayBatch::inBatches(patches.surfelCount, [&](uint32_t first, uint32_t count) {
            stream.dispatch(
                aim_, {{"pivots", pivots}, {"rays", batch.rays}, {"PatchSurfelsAt", patches.surfels.at()}},
                SideAimPush{first, count, isCovered}, linearGroups(count));
            context.tracer.occluded(stream, batch.rays, batch.occluded, count);
            stream.dispatch(join_, {{"occluded", batch.occluded}, {"PatchSurfelsAt", patches.surfels.at()}},
                            JoinPush{first, count, round, i + 1 == kMaxPatchSides ? 1u : 0u, isCovered},
                            linearGroups(count));
        });
    }
    stream.finish();
}

}  // namespace voxray
