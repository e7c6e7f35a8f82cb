#include "passes/path_trace/path_trace_ports.h"

#include "base/error.h"

namespace voxray {

void PathTracePorts::planOutputs(PassPlan& plan, const char* pass) {
    if (params_.light == PathLight::Indirect && plan[images_[0].port].isRead)
        throw Error("{}: with 'light: indirect' it writes no 'final'; let composite follow", pass);
    options_ = {.width = plan.frame.width,
                .height = plan.frame.height,
                .spp = params_.spp,
                .bounces = params_.bounces,
                .light = params_.light,
                .stratifiedOver = params_.stratifiedOver,
                .keepSums = plan[sums_].isRead && params_.light == PathLight::All && params_.spp > 1};
    for (const RenderedImage& image : images_) {
        FrameImage& frame = plan[image.port];
        frame.lightBounces = params_.bounces;
        frame.hasSpecularLobes = true;
        if (frame.isRead && isRendered(image)) plan.frameImage(image.port);
    }
    if (NoisyIrradiance& noisy = plan[noisy_]; noisy.isRead) {
        const uint32_t texels = plan[gbuffer_] ? plan[gbuffer_]->samples : 1;
        options_.irradianceTexels = texels;
        noisy.lightBounces = params_.bounces;
        noisy.spacing = texels;
        noisy.blockSize = texels * options_.momentsPixels();
        plan.image(noisy.irradiance, "path traced irradiance", NoisyIrradiance::desc(plan.frame, texels));
        plan.buffer(noisy.moments, "moments of paths", noisy.momentsBytes(gbufferExtent(plan.frame, texels)));
    }
}

}  // namespace voxray
