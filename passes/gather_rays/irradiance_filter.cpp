#include "passes/gather_rays/irradiance_filter.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/view/camera_matrix.h"
#include "passes/common/view/frame_image.h"
#include "shaders/filter/gather_filter.h"

namespace voxray {
namespace {

struct GuidePush {
    gpu::GatherLayout layout;
    glm::vec3 camera;
    float texelAngle;
};

struct FilterPush {
    glm::uvec2 texels;
    int32_t step;
    float strictness;
};

constexpr uint64_t kIrradianceBytes = 4 * sizeof(float);
constexpr uint64_t kBlockBytes = 2 * sizeof(float);

uint64_t texelCount(const GatherHits& hits) {
    return uint64_t(hits.layout.texels.x) * hits.layout.texels.y;
}

}  // namespace

IrradianceFilter::IrradianceFilter(PassSetup& setup, const GatherHits& hits)
    : blocks_(makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_rays/blocks.comp"))),
      guide_(makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_rays/guide.comp"))),
      filter_(makeComputeProgram(setup.device, setup.compiler.compile("passes/gather_rays/filter.comp"))),
      sampler_(texelSampler(setup.device)),
      gathered_(setup.device, "gathered irradiance", texelCount(hits) * kIrradianceBytes),
      filtered_(setup.device, "filtered irradiance", texelCount(hits) * kIrradianceBytes),
      moments_(setup.device, "moments of blocks", hits.blocks() * sizeof(gpu::GatherMoments)),
      blockLight_(setup.device, "light about blocks", hits.blocks() * kBlockBytes),
      guides_(setup.device, "guide of the filter", texelCount(hits) * sizeof(gpu::FilterTexel)) {}

uint64_t IrradianceFilter::bytes(const GatherHits& hits) {
    return texelCount(hits) * (2 * kIrradianceBytes + sizeof(gpu::FilterTexel)) +
           hits.blocks() * (sizeof(gpu::GatherMoments) + kBlockBytes);
}

const Buffer& IrradianceFilter::run(PassContext& context, const GBuffer& gbuffer, const GatherHits& hits,
                                    uint32_t levels, float strictness) const {
    if (levels == 0) return gathered_;
    const glm::uvec2 texels = hits.layout.texels;
    const glm::uvec3 groups = pixelGroups(texels.x, texels.y);
    const CameraRays camera = cameraRays(context.frame.camera, texels.x, texels.y);
    const glm::uvec2 blocks = hits.layout.blocks;
    context.stream.dispatch(blocks_, {{"moments", moments_}, {"blocks", blockLight_}}, blocks,
                            pixelGroups(blocks.x, blocks.y));
    context.stream.dispatch(
        guide_,
        {{"position", gbuffer.position, sampler_},
         {"normal", gbuffer.normal, sampler_},
         {"blocks", blockLight_},
         {"guide", guides_}},
        GuidePush{hits.layout, camera.origin, 2 * glm::length(camera.up) / float(texels.y)}, groups);
    const Buffer *from = &gathered_, *to = &filtered_;
    for (uint32_t level = 0; level < levels; ++level, std::swap(from, to))
        context.stream.dispatch(filter_, {{"guide", guides_}, {"source", *from}, {"result", *to}},
                                FilterPush{texels, 1 << level, strictness}, groups);
    return *from;
}

}  // namespace voxray
