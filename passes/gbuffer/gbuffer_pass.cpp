#include "passes/gbuffer/gbuffer_pass.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/common/view/camera_matrix.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays and hits to 48 MiB.
constexpr VkFormat kWide = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kHalf = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kByte = VK_FORMAT_R8G8B8A8_UNORM;

/// The images, in the order in which gbuffer.frag writes them.
struct Target {
    const char* name;
    Image GBuffer::*image;
    VkFormat format;
    bool cleared;  ///< Before surfaces are drawn; else it holds the environment.
};
constexpr Target kTargets[] = {{"gbuffer position", &GBuffer::position, kWide, true},
                               {"gbuffer normal", &GBuffer::normal, kHalf, true},
                               {"gbuffer geometric normal", &GBuffer::geometricNormal, kHalf, true},
                               {"gbuffer albedo", &GBuffer::albedo, kHalf, true},
                               {"gbuffer emission", &GBuffer::emission, kWide, false},
                               {"gbuffer specular", &GBuffer::specular, kHalf, true},
                               {"gbuffer fresnel", &GBuffer::fresnel, kByte, true}};

struct RaysPush {
    View view;
    uint32_t firstTexel;
    uint32_t batchRays;
};

struct ShadePixelsPush {
    glm::mat4 viewProjection;
    View view;
};

struct MotionPush {
    View view, previousView;
};

View viewOf(const Frame& frame, glm::uvec2 extent) {
    const CameraRays rays = cameraRays(frame.camera, frame.width, frame.height);
    return {rays.origin, extent.x, rays.forward, extent.y, rays.right, rays.up};
}

ImageDesc targetDesc(glm::uvec2 extent, VkFormat format) {
    ImageDesc desc;
    desc.format = format;
    desc.extent = {extent, 1};
    desc.usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return desc;
}

ImageDesc depthTarget(glm::uvec2 extent) {
    ImageDesc desc = targetDesc(extent, VK_FORMAT_D32_SFLOAT);
    desc.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return desc;
}

uint64_t batchRays(glm::uvec2 extent) {
    return std::min<uint64_t>(uint64_t(extent.x) * extent.y, kBatchRays);
}

}  // namespace

void GBufferPass::declare(PassBuilder& builder) {
    gbuffer_ = builder.write<GBuffer>("gbuffer", "what the camera sees");
    motion_ = builder.write<SurfaceMotion>("motion", "where it was in the frame before");
}

void GBufferPass::plan(PassPlan& plan) {
    GBuffer& g = plan.get(gbuffer_);
    g.samples = params_.samplesPerPixelEdge;
    const glm::uvec2 extent = gbufferExtent(plan.frame, params_.samplesPerPixelEdge);
    for (const Target& t : kTargets) plan.image(g.*t.image, t.name, targetDesc(extent, t.format));
    if (hasMotion(plan)) {
        const Geometry& geometry = plan.frame.scene->geometry;
        SurfaceMotion& motion = plan.get(motion_);
        plan.image(motion.motion, "motion", targetDesc(extent, kWide));
        plan.image(motion.previous, "previous position", targetDesc(extent, kWide));
        plan.buffer(previousPositions_, "previous vertices", geometry.positions.size() * sizeof(glm::vec3));
        plan.buffer(instanceStarts_, "instances", geometry.instances.size() * sizeof(uint32_t));
    }
    if (params_.method == GBufferMethod::Raster) {
        plan.image(depth_, "gbuffer depth", depthTarget(extent));
    } else {
        plan.buffer(rays_, "camera rays", batchRays(extent) * sizeof(Ray));
        plan.buffer(hits_, "camera ray hits", batchRays(extent) * sizeof(Hit));
    }
}

void GBufferPass::prepare(PassSetup& setup) {
    Defines defines;
    if (params_.normalMaps == TextureLookup::Sharp) defines.emplace("SHARP_NORMALS", "1");
    if (params_.colors == TextureLookup::Sharp) defines.emplace("SHARP_COLORS", "1");
    if (hasMotion(setup)) defines.emplace("MOTION", "1");
    const auto compile = [&](const char* file) {
        return setup.compiler.compile(std::string("passes/gbuffer/") + file, defines);
    };
    if (hasMotion(setup)) {
        findMotion_ = makeComputeProgram(setup.device, compile("motion.comp"));
        sampler_ = texelSampler(setup.device);
        std::vector<uint32_t> starts;
        for (const InstanceRange& range : setup.frame.scene->geometry.instances)
            starts.push_back(range.firstTriangle);
        setup.stream.upload(instanceStarts_, starts);
        before_.reset();
    }
    if (params_.method == GBufferMethod::Rays) {
        aim_ = makeComputeProgram(setup.device, compile("aim.comp"));
        shade_ = makeComputeProgram(setup.device, compile("shade.comp"));
        return;
    }
    background_ = makeComputeProgram(setup.device, compile("background.comp"));
    const ShaderModule stages[] = {compile("gbuffer.vert"), compile("gbuffer.frag")};
    RasterState state;
    for (const Target& t : kTargets) state.colorFormats.push_back(t.format);
    if (hasMotion(setup)) state.colorFormats.push_back(kWide);
    state.depthFormat = VK_FORMAT_D32_SFLOAT;
    state.depthCompare = VK_COMPARE_OP_GREATER;
    surfaces_ = makeRasterProgram(setup.device, stages, state);
}

void GBufferPass::record(PassContext& context) {
    if (hasMotion(context)) beginMotion(context);
    if (params_.method == GBufferMethod::Rays)
        trace(context);
    else
        rasterize(context);
    if (hasMotion(context)) endMotion(context);
}

void GBufferPass::beginMotion(PassContext& context) {
    if (before_) return;
    const glm::uvec2 extent = gbufferExtent(context.frame, params_.samplesPerPixelEdge);
    context.stream.copy(context.scene.positions, previousPositions_, previousPositions_.bytes());
    before_ = {viewOf(context.frame, extent), context.frame.sceneVersion};
}

void GBufferPass::endMotion(PassContext& context) {
    const SurfaceMotion& motion = context.get(motion_);
    const glm::uvec2 extent = gbufferExtent(context.frame, params_.samplesPerPixelEdge);
    const View view = viewOf(context.frame, extent);
    context.stream.dispatch(findMotion_,
                            {{"position", context.get(gbuffer_).position, sampler_},
                             {"previous", motion.previous, sampler_},
                             {"motion", motion.motion}},
                            MotionPush{view, before_->view}, pixelGroups(extent.x, extent.y));

    // For the next frame
    if (before_->sceneVersion != context.frame.sceneVersion)
        context.stream.copy(context.scene.positions, previousPositions_, previousPositions_.bytes());
    before_ = {view, context.frame.sceneVersion};
}

void GBufferPass::trace(PassContext& context) {
    const GBuffer& g = context.get(gbuffer_);
    const glm::uvec2 extent = gbufferExtent(context.frame, params_.samplesPerPixelEdge);
    const View view = viewOf(context.frame, extent);
    const uint32_t texels = extent.x * extent.y;
    for (uint32_t first = 0; first < texels; first += kBatchRays) {
        const uint32_t batch = std::min(kBatchRays, texels - first);
        const RaysPush push{view, first, batch};
        context.stream.dispatch(aim_, {{"rays", rays_}}, push, linearGroups(batch));
        context.tracer.closestHit(context.stream, rays_, hits_, batch, Coherence::Coherent);
        std::vector<Binding> bindings = context.scene.bindings({{"hits", hits_},
                                                                {"position", g.position},
                                                                {"normal", g.normal},
                                                                {"geometricNormal", g.geometricNormal},
                                                                {"albedo", g.albedo},
                                                                {"emitted", g.emission},
                                                                {"specular", g.specular},
                                                                {"fresnel", g.fresnel}});
        if (hasMotion(context)) {
            bindings.emplace_back("previous", context.get(motion_).previous);
            bindings.emplace_back("PreviousPositionsAt", previousPositions_.at());
            bindings.emplace_back("instanceStarts", instanceStarts_);
        }
        context.stream.dispatch(shade_, bindings, push, linearGroups(batch));
    }
}

void GBufferPass::rasterize(PassContext& context) {
    const GBuffer& g = context.get(gbuffer_);
    const Frame& frame = context.frame;
    const glm::uvec2 extent = gbufferExtent(frame, params_.samplesPerPixelEdge);
    const View view = viewOf(frame, extent);

    // The environment behind everything.
    context.stream.dispatch(background_, context.scene.bindings({{"background", g.emission}}), view,
                            pixelGroups(extent.x, extent.y));

    // All triangles over it, with depth test.
    const Geometry& geometry = frame.scene->geometry;
    RasterTargets targets;
    for (const Target& t : kTargets) {
        targets.colors.push_back({&(g.*t.image), {}});
        if (t.cleared) targets.colors.back().clear = VkClearColorValue{};
    }
    std::vector<Binding> bindings = context.scene.bindings({});
    if (hasMotion(context)) {
        targets.colors.push_back({&context.get(motion_).previous, VkClearColorValue{}});
        bindings.emplace_back("PreviousPositionsAt", previousPositions_.at());
        bindings.emplace_back("instanceStarts", instanceStarts_);
    }
    targets.depth = &depth_;
    targets.depthClear = 0;
    targets.extent = {extent, 1};
    const ShadePixelsPush push{viewProjection(frame.camera, frame.width, frame.height, geometry), view};
    context.stream.draw(surfaces_, bindings, push, targets, context.scene.triangleCount * 3);
}

}  // namespace voxray
