#include "passes/clusters/gather_clusters/visible_points.h"

#include "scene/camera_rays.h"

namespace voxray {

VisiblePoints::VisiblePoints(ProgramOwner& owner)
    : generateRays_(owner, "generate_visibility_rays.comp"), markVoxels_(owner, "mark_voxels_by_points.comp") {}

void VisiblePoints::mark(PassContext& context, const SurfaceVoxels& voxels, const Buffer& coordinates,
                         const Buffer& requested, const Buffer& newVoxels, const Buffer& count) const {
    const Frame& frame = context.frame;
    const CameraRays camera = cameraRays(frame.camera, frame.width, frame.height);
    const auto batchBindings = [&](const VoxelPointRays::Batch& batch) {
        return std::vector<Binding>{
            {"requestedVoxels", requested},   {"rays", rays_.rays()},   {"grid", voxels.grid},
            {"firstVoxel", batch.firstVoxel}, {"voxels", batch.voxels}, {"origin", camera.origin},
            {"forward", camera.forward},      {"right", camera.right},  {"up", camera.up}};
    };
    const auto generate = [&](const VoxelPointRays::Batch& batch) {
        context.dispatch(generateRays_, batch.voxels * kPoints, {batchBindings(batch), {"coordinates", coordinates}});
    };
    const auto mark = [&](const VoxelPointRays::Batch& batch) {
        context.dispatch(
            markVoxels_, batch.voxels,
            {batchBindings(batch), {"occluded", rays_.occluded()}, {"newVoxels", newVoxels}, {"count", count}});
    };
    rays_.trace(context, voxels.voxelCount, generate, mark);
}

}  // namespace voxray
