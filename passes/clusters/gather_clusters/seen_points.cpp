#include "passes/clusters/gather_clusters/seen_points.h"

#include "scene/camera_rays.h"

namespace voxray {

SeenPoints::SeenPoints(ProgramOwner& owner)
    : aim_(owner, "aim_points.comp"), mark_(owner, "mark_points.comp") {}

void SeenPoints::mark(PassContext& context, const SurfaceVoxels& voxels, const Buffer& coordinates,
                      const Buffer& asked, const Buffer& found, const Buffer& count) const {
    const Frame& frame = context.frame;
    const CameraRays camera = cameraRays(frame.camera, frame.width, frame.height);
    const auto given = [&](const PointRays::Batch& batch) {
        return std::vector<Binding>{{"asked", asked},
                                    {"rays", rays_.rays()},
                                    {"grid", voxels.grid},
                                    {"firstVoxel", batch.firstVoxel},
                                    {"voxels", batch.voxels},
                                    {"origin", camera.origin},
                                    {"forward", camera.forward},
                                    {"right", camera.right},
                                    {"up", camera.up}};
    };
    const auto aim = [&](const PointRays::Batch& batch) {
        context.dispatch(aim_, batch.voxels * kPoints, {given(batch), {"coordinates", coordinates}});
    };
    const auto mark = [&](const PointRays::Batch& batch) {
        context.dispatch(mark_, batch.voxels,
                         {given(batch), {"occluded", rays_.occluded()}, {"found", found}, {"count", count}});
    };
    rays_.trace(context, voxels.voxelCount, aim, mark);
}

}  // namespace voxray
