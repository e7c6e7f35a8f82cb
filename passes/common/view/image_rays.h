#pragma once

#include "graph/pass.h"
#include "scene/camera_rays.h"

namespace voxray {

/// Camera rays through low-discrepancy points of the image.
class ImageRays {
 public:
    explicit ImageRays(ProgramOwner& owner) : program_(owner, "image_rays.comp") {}

    /// Writes rays [first, first + count) of the sequence with this seed. @param rays Ray each.
    void record(PassContext& context, const Buffer& rays, uint32_t first, uint32_t count, uint32_t seed) const {
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

 private:
    Kernel program_;
};

}  // namespace voxray
