#include "passes/clusters/inject_clusters/lit_points.h"

namespace voxray {

LitPoints::LitPoints(ProgramOwner& owner) : aim_(owner, "aim_points.comp"), add_(owner, "add_lit.comp") {}

void LitPoints::measure(PassContext& context, const std::vector<LightSource>& sources,
                        const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                        const VoxelPatches& patches, const LargeBuffer& surfels) const {
    for (const LightSource& source : sources) {
        const auto given = [&](const PointRays::Batch& batch) {
            return Bindings{context.scene,
                            voxels,
                            {"coordinates", clusters.coordinates},
                            {"rays", rays_.rays()},
                            {"firstVoxel", batch.firstVoxel},
                            {"voxels", batch.voxels},
                            {"light", source.light}}
                .all();
        };
        const auto aim = [&](const PointRays::Batch& batch) {
            context.dispatch(aim_, batch.voxels * kPoints, {given(batch)});
        };
        const auto add = [&](const PointRays::Batch& batch) {
            context.dispatch(add_, batch.voxels,
                             {given(batch),
                              {"VoxelMaterialsAt", patches.materials.at()},
                              {"occluded", rays_.occluded()},
                              {"firstSide", patches.firstSide},
                              {"sides", patches.sides},
                              {"PatchSurfelsAt", patches.surfels.at()},
                              {"PlacedAt", surfels.at()}});
        };
        rays_.trace(context, voxels.voxelCount, aim, add);
    }
}

}  // namespace voxray
