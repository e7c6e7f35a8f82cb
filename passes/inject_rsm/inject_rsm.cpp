#include "passes/inject_rsm/inject_rsm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "passes/common/dispatch.h"

namespace voxray {
namespace {

constexpr uint32_t kMostBatchTexels = 1u << 20;  // Bounds the memory of rays and what they carry to 108 MiB.
constexpr VkFormat kSeenFormat = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

/// As in rsm_view.glsl.
struct ViewPush {
    glm::vec3 origin;
    float halfExtent;
    glm::vec3 right;
    float near;
    glm::vec3 up;
    float far;
    glm::vec3 forward;
    uint32_t parallel;
    uint32_t light;
    uint32_t resolution;
    uint32_t firstTexel;
    uint32_t texels;
};

ViewPush makeView(glm::vec3 origin, glm::vec3 forward, float halfExtent) {
    ViewPush view{};
    view.origin = origin;
    view.halfExtent = halfExtent;
    view.forward = forward;
    view.right = glm::normalize(
        glm::cross(forward, std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    view.up = glm::cross(view.right, forward);
    return view;
}

/// The views that see all that a light shines on.
std::vector<ViewPush> lightViews(const Light& light, const Geometry& geometry) {
    const BoundingSphere sphere = boundingSphere(geometry);
    if (light.type == LightType::Directional) {
        ViewPush view =
            makeView(sphere.centre - light.direction * sphere.radius, light.direction, sphere.radius);
        view.far = 2 * sphere.radius;
        view.parallel = 1;
        return {view};
    }
    // A spot that one side of the cube can hold takes a view of its own.
    std::vector<ViewPush> views;
    if (light.type == LightType::Spot && light.outerConeAngle <= std::numbers::pi_v<float> / 4)
        views = {makeView(light.position, light.direction, std::tan(light.outerConeAngle))};
    else
        for (int axis = 0; axis < 3; ++axis)
            for (const float sign : {1.0f, -1.0f}) {
                glm::vec3 forward(0.0f);
                forward[axis] = sign;
                views.push_back(makeView(light.position, forward, 1.0f));
            }
    for (ViewPush& view : views) {
        view.far = glm::length(light.position - sphere.centre) + sphere.radius;
        view.near = view.far * 1e-4f;
    }
    return views;
}

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
    const std::vector<LightSource> sources = requireLightSources(*plan.frame.scene, kName);
    for (const LightSource& source : sources)
        if (source.kind != LightSource::Punctual)
            throw Error(
                "{}: {} no single viewpoint to render a shadow map from; use inject_light_rays, or point, "
                "spot and directional lights alone",
                kName,
                source.kind == LightSource::Emitters ? "emissive surfaces have" : "an environment has");
    plan.reserve("shadow map images",
                 imageBytes(seenDesc(params_.resolution)) + imageBytes(depthDesc(params_.resolution)));
    LightPaths::plan(plan, kName, params_, std::min(texels(), kMostBatchTexels), plan.get(voxels_), sources);
}

void InjectRsm::prepare(PassSetup& setup) {
    seen_ = Image(setup.device, "shadow map hits", seenDesc(params_.resolution));
    depth_ = Image(setup.device, "shadow map depth", depthDesc(params_.resolution));
    const ShaderModule stages[] = {setup.compiler.compile("passes/inject_rsm/rsm.vert"),
                                   setup.compiler.compile("passes/inject_rsm/rsm.frag")};
    RasterState state;
    state.colorFormats = {kSeenFormat};
    state.depthFormat = kDepthFormat;
    rasterize_ = makeRasterProgram(setup.device, stages, state);
    makeRays_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/inject_rsm/rsm_rays.comp"));
    paths_ = LightPaths(setup, params_, std::min(texels(), kMostBatchTexels));
}

void InjectRsm::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const SceneState& state = *context.frame.scene;
    const std::vector<LightSource> sources = lightSources(state);
    paths_.begin(context, voxels, sources);
    for (uint32_t s = 0; s < sources.size(); ++s) {
        const uint32_t seed = uint32_t(context.frame.seed * 0x9e3779b9u) + s * 0x85ebca6bu;
        const std::vector<ViewPush> views = lightViews(state.lights[sources[s].light], state.geometry);
        for (uint32_t v = 0; v < views.size(); ++v) {
            // What each texel sees.
            ViewPush view = views[v];
            view.light = sources[s].light;
            view.resolution = params_.resolution;
            RasterTargets targets;
            VkClearColorValue nothing{};
            std::ranges::fill(nothing.uint32, Hit::kMiss);
            targets.colors = {{&seen_, nothing}};
            targets.depth = &depth_;
            targets.extent = {params_.resolution, params_.resolution, 1};
            context.stream.draw(rasterize_, context.scene.bindings({}), view, targets,
                                context.scene.triangleCount * 3);

            // Texels are light rays with known hits.
            for (view.firstTexel = 0; view.firstTexel < texels(); view.firstTexel += kMostBatchTexels) {
                view.texels = std::min(kMostBatchTexels, texels() - view.firstTexel);
                context.stream.dispatch(makeRays_,
                                        context.scene.bindings({{"rays", paths_.rays()},
                                                                {"hits", paths_.hits()},
                                                                {"paths", paths_.paths()},
                                                                {"seen", seen_}}),
                                        view, linearGroups(view.texels));
                paths_.follow(context, voxels, {seed, v * texels() + view.firstTexel, view.texels, true});
            }
        }
    }
    paths_.finish(context, voxels, context.get(irradiance_));
}

}  // namespace voxray
