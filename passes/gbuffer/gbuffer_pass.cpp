#include "passes/gbuffer/gbuffer_pass.h"

#include "passes/common/camera_matrix.h"
#include "passes/common/dispatch.h"

namespace voxray {
namespace {

struct BackgroundPush {
    glm::vec3 forward;
    uint32_t width;
    glm::vec3 right;
    uint32_t height;
    glm::vec3 up;
    float padding = 0;
};

struct SurfacePush {
    glm::mat4 viewProjection;
    glm::vec3 cameraPosition;
    float padding = 0;
};

ImageDesc target(const Frame& frame, VkFormat format) {
    ImageDesc desc;
    desc.format = format;
    desc.extent = {frame.width, frame.height, 1};
    desc.usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return desc;
}

ImageDesc depthTarget(const Frame& frame) {
    ImageDesc desc = target(frame, VK_FORMAT_D32_SFLOAT);
    desc.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return desc;
}

constexpr VkFormat kWide = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kHalf = VK_FORMAT_R16G16B16A16_SFLOAT;

}  // namespace

void GBufferPass::declare(PassBuilder& builder) {
    gbuffer_ = builder.write<GBuffer>("gbuffer", "what the camera sees, per pixel");
}

void GBufferPass::plan(PassPlan& plan) {
    uint64_t bytes = imageBytes(depthTarget(plan.frame));
    for (const VkFormat format : {kWide, kHalf, kHalf, kHalf, kWide})
        bytes += imageBytes(target(plan.frame, format));
    plan.reserve("g-buffer images", bytes);
}

void GBufferPass::prepare(PassSetup& setup) {
    GBuffer& g = setup.get(gbuffer_);
    g.position = Image(setup.device, "gbuffer position", target(setup.frame, kWide));
    g.normal = Image(setup.device, "gbuffer normal", target(setup.frame, kHalf));
    g.geometricNormal = Image(setup.device, "gbuffer geometric normal", target(setup.frame, kHalf));
    g.albedo = Image(setup.device, "gbuffer albedo", target(setup.frame, kHalf));
    g.emission = Image(setup.device, "gbuffer emission", target(setup.frame, kWide));
    g.depth = Image(setup.device, "gbuffer depth", depthTarget(setup.frame));

    background_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/gbuffer/background.comp"));
    const ShaderModule stages[] = {setup.compiler.compile("passes/gbuffer/gbuffer.vert"),
                                   setup.compiler.compile("passes/gbuffer/gbuffer.frag")};
    RasterState state;
    state.colorFormats = {kWide, kHalf, kHalf, kHalf, kWide};
    state.depthFormat = VK_FORMAT_D32_SFLOAT;
    surfaces_ = makeRasterProgram(setup.device, stages, state);
}

void GBufferPass::record(PassContext& context) {
    GBuffer& g = context.get(gbuffer_);
    const Frame& frame = context.frame;

    // The environment behind everything.
    const CameraRays rays = cameraRays(frame.camera, frame.width, frame.height);
    context.stream.dispatch(background_, context.scene.bindings({{"background", g.emission}}),
                            BackgroundPush{rays.forward, frame.width, rays.right, frame.height, rays.up},
                            pixelGroups(frame.width, frame.height));

    // All triangles over it, with depth test.
    const Geometry& geometry = frame.scene->geometry;
    RasterTargets targets;
    const VkClearColorValue zero{};
    targets.colors = {{&g.position, zero},
                      {&g.normal, zero},
                      {&g.geometricNormal, zero},
                      {&g.albedo, zero},
                      {&g.emission, {}}};
    targets.depth = &g.depth;
    targets.extent = {frame.width, frame.height, 1};
    const SurfacePush push{
        viewProjection(frame.camera, frame.width, frame.height, geometry.boundsMin, geometry.boundsMax),
        frame.camera.position};
    context.stream.draw(surfaces_, context.scene.bindings({}), push, targets,
                        context.scene.triangleCount * 3);
}

}  // namespace voxray
