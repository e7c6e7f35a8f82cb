#include "passes/inject_clusters/lit_points.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct Push {
    gpu::VoxelGrid grid;
    uint32_t firstVoxel;
    uint32_t voxels;
    uint32_t light;
};

}  // namespace

void LitPoints::plan(PassPlan& plan) {
    rays_.plan(plan);
}

void LitPoints::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    aim_ = program("passes/inject_clusters/aim_points.comp");
    add_ = program("passes/inject_clusters/add_lit.comp");
}

void LitPoints::measure(PassContext& context, const std::vector<LightSource>& sources,
                        const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                        const VoxelPatches& patches, const LargeBuffer& surfels) const {
    CommandStream& stream = context.stream;
    for (const LightSource& source : sources) {
        const auto push = [&](const PointRays::Batch& batch) {
            return Push{voxels.grid, batch.firstVoxel, batch.voxels, source.light};
        };
        const auto aim = [&](const PointRays::Batch& batch) {
            stream.dispatch(
                aim_, context.scene.bindings({{"coordinates", clusters.coordinates}, {"rays", rays_.rays()}}),
                push(batch), linearGroups(batch.voxels * kPoints));
        };
        const auto add = [&](const PointRays::Batch& batch) {
            stream.dispatch(add_,
                            context.scene.bindings({{"coordinates", clusters.coordinates},
                                                    {"voxelOccupancy", voxels.occupancy},
                                                    {"voxelRank", voxels.rank},
                                                    {"VoxelMaterialsAt", patches.materials.at()},
                                                    {"rays", rays_.rays()},
                                                    {"occluded", rays_.occluded()},
                                                    {"firstSide", patches.firstSide},
                                                    {"sides", patches.sides},
                                                    {"PatchSurfelsAt", patches.surfels.at()},
                                                    {"PlacedAt", surfels.at()}}),
                            push(batch), linearGroups(batch.voxels));
        };
        rays_.trace(context, voxels.voxelCount, aim, add);
    }
}

}  // namespace voxray
