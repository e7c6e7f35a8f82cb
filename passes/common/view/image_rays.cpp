#include "passes/common/view/image_rays.h"

#include "passes/common/compute/dispatch.h"
#include "scene/camera_rays.h"

namespace voxray {
namespace {

struct Push {
    glm::vec3 origin;
    uint32_t firstRay;
    glm::vec3 forward;
    uint32_t count;
    glm::vec3 right;
    uint32_t seed;
    glm::vec3 up;
};

}  // namespace

void ImageRays::prepare(PassSetup& setup) {
    program_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/common/view/image_rays.comp"));
}

void ImageRays::record(PassContext& context, const Buffer& rays, uint32_t first, uint32_t count,
                       uint32_t seed) const {
    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    context.stream.dispatch(program_, {{"rays", rays}},
                            Push{camera.origin, first, camera.forward, count, camera.right, seed, camera.up},
                            linearGroups(count));
}

}  // namespace voxray
