#include "passes/inject_rsm/inject_rsm.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/lights/light_views.h"

namespace voxray {
namespace {

constexpr uint32_t kMaxBatchTexels = 1u << 20;  // Bounds the memory of rays and what they carry to 108 MiB.
constexpr VkFormat kSeenFormat = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

struct RaysPush {
    gpu::LightView view;
    uint32_t light;
    uint32_t resolution;
    uint32_t firstTexel;
    uint32_t texels;
};

ImageDesc targetDesc(uint32_t resolution, VkFormat format, VkImageUsageFlags usage) {
    ImageDesc desc;
    desc.format = format;
    desc.extent = {resolution, resolution, 1};
    desc.usage = usage;
    return desc;
}

ImageDesc seenDesc(uint32_t resolution) {
    return targetDesc(resolution, kSeenFormat,
                      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT);
}

ImageDesc depthDesc(uint32_t resolution) {
    return targetDesc(resolution, kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
}

}  // namespace

void InjectRsm::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels to light");
    irradiance_ = builder.write<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
}

void InjectRsm::plan(PassPlan& plan) {
    const std::vector<LightSource> sources = requireViewpoints(*plan.frame.scene, kName);
    plan.image(seen_, "shadow map hits", seenDesc(params_.rsmResolution));
    plan.image(depth_, "shadow map depth", depthDesc(params_.rsmResolution));
    paths_.plan(plan, kName, params_, std::min(texels(), kMaxBatchTexels), plan.get(voxels_), sources);
}

void InjectRsm::prepare(PassSetup& setup) {
    const ShaderModule stages[] = {setup.compiler.compile("passes/common/lights/light_view.vert"),
                                   setup.compiler.compile("passes/inject_rsm/rsm.frag")};
    RasterState state;
    state.colorFormats = {kSeenFormat};
    state.depthFormat = kDepthFormat;
    rasterize_ = makeRasterProgram(setup.device, stages, state);
    makeRays_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_rsm/rsm_rays.comp"));
    paths_.prepare(setup);
}

void InjectRsm::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const SceneState& state = *context.frame.scene;
    const std::vector<LightSource> sources = lightSources(state);
    paths_.begin(context, voxels, sources);
    for (uint32_t s = 0; s < sources.size(); ++s) {
        const uint32_t seed = randomSeed(context.frame, s);
        const std::vector<gpu::LightView> views = lightViews(state.lights[sources[s].light], state.geometry);
        for (uint32_t v = 0; v < views.size(); ++v) {
            // What each texel sees.
            RasterTargets targets;
            VkClearColorValue nothing{};
            std::ranges::fill(nothing.uint32, Hit::kMiss);
            targets.colors = {{&seen_, nothing}};
            targets.depth = &depth_;
            targets.extent = {params_.rsmResolution, params_.rsmResolution, 1};
            context.stream.draw(rasterize_, context.scene.bindings({}), views[v], targets,
                                context.scene.triangleCount * 3);

            // Texels are light rays with known hits.
            for (uint32_t first = 0; first < texels(); first += kMaxBatchTexels) {
                const uint32_t batch = std::min(kMaxBatchTexels, texels() - first);
                context.stream.dispatch(
                    makeRays_,
                    context.scene.bindings({{"rays", paths_.rays()},
                                            {"hits", paths_.hits()},
                                            {"paths", paths_.paths()},
                                            {"seen", seen_}}),
                    RaysPush{views[v], sources[s].light, params_.rsmResolution, first, batch},
                    linearGroups(batch));
                paths_.follow(context, voxels, {seed, v * texels() + first, batch, true});
            }
        }
    }
    paths_.finish(context, voxels, context.get(irradiance_));
}

}  // namespace voxray
