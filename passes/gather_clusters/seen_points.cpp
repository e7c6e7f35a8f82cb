#include "passes/gather_clusters/seen_points.h"

#include "passes/common/compute/dispatch.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

struct Push {
    gpu::VoxelGrid grid;
    uint32_t firstVoxel;
    uint32_t voxels;
    glm::vec3 origin;
    glm::vec3 forward;
    glm::vec3 right;
    glm::vec3 up;
};

}  // namespace

void SeenPoints::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    aim_ = program("passes/gather_clusters/aim_points.comp");
    mark_ = program("passes/gather_clusters/mark_points.comp");
}

void SeenPoints::mark(PassContext& context, const SurfaceVoxels& voxels, const Buffer& coordinates,
                      const Buffer& asked, const Buffer& found, const Buffer& count) const {
    CommandStream& stream = context.stream;
    const Frame& frame = context.frame;
    const CameraRays camera = cameraRays(frame.camera, frame.width, frame.height);
    const auto push = [&](const PointRays::Batch& batch) {
        return Push{voxels.grid,    batch.firstVoxel, batch.voxels, camera.origin,
                    camera.forward, camera.right,     camera.up};
    };
    const auto aim = [&](const PointRays::Batch& batch) {
        stream.dispatch(aim_, {{"coordinates", coordinates}, {"asked", asked}, {"rays", rays_.rays()}},
                        push(batch), linearGroups(batch.voxels * kPoints));
    };
    const auto mark = [&](const PointRays::Batch& batch) {
        stream.dispatch(mark_,
                        {{"asked", asked},
                         {"rays", rays_.rays()},
                         {"occluded", rays_.occluded()},
                         {"found", found},
                         {"count", count}},
                        push(batch), linearGroups(batch.voxels));
    };
    rays_.trace(context, voxels.voxelCount, aim, mark);
}

}  // namespace voxray
