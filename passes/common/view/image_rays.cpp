#include "passes/common/view/image_rays.h"

#include "scene/camera_rays.h"

namespace voxray {

ImageRays::ImageRays(ProgramOwner& owner) : program_(owner, "image_rays.comp") {}

void ImageRays::record(PassContext& context, const Buffer& rays, uint32_t first, uint32_t count,
                       uint32_t seed) const {
    const CameraRays camera = cameraRays(context.frame.camera, context.frame.width, context.frame.height);
    context.dispatch(program_, count,
                     {{"rays", rays},
                      {"origin", camera.origin},
                      {"firstRay", first},
                      {"forward", camera.forward},
                      {"count", count},
                      {"right", camera.right},
                      {"seed", seed},
                      {"up", camera.up}});
}

}  // namespace voxray
