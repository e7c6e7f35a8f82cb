#include "passes/clusters/inject_clusters/lit_points.h"

namespace voxray {

LitPoints::LitPoints(ProgramOwner& owner)
    : generateRays_(owner, "generate_shadow_rays.comp"), addLight_(owner, "add_punctual_light.comp") {}

void LitPoints::measure(PassContext& context, const std::vector<LightSource>& sources, const SurfaceVoxels& voxels,
                        const VoxelClusters& clusters, const SurfelPoints& points, const VoxelPatches& patches,
                        const LargeBuffer& surfelIrradiance) const {
    for (const LightSource& source : sources) {
        const auto batchBindings = [&](const VoxelPointRays::Batch& batch) {
            return Bindings{context.scene,
                            voxels,
                            {"coordinates", clusters.coordinates},
                            {"rays", rays_.rays()},
                            {"firstVoxel", batch.firstVoxel},
                            {"voxels", batch.voxels},
                            {"light", source.light}}
                .all();
        };
        const auto generate = [&](const VoxelPointRays::Batch& batch) {
            context.dispatch(generateRays_, batch.voxels * kPoints, {batchBindings(batch), {"pointSeed", points.seed}});
        };
        const auto add = [&](const VoxelPointRays::Batch& batch) {
            context.dispatch(addLight_, batch.voxels,
                             {batchBindings(batch),
                              points,
                              {"GroupMaterialsRef", patches.materials.ref()},
                              {"occluded", rays_.occluded()},
                              {"firstGroup", patches.firstGroup},
                              {"groups", patches.groups},
                              {"SurfelIdsRef", patches.surfelIds.ref()},
                              {"SurfelIrradianceRef", surfelIrradiance.ref()}});
        };
        rays_.trace(context, voxels.voxelCount, generate, add);
    }
}

}  // namespace voxray
