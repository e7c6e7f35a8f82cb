#include <algorithm>
#include <array>
#include <optional>

#include "graph/registry.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/view/camera_matrix.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/view/surface_motion.h"

namespace voxray {

enum class GBufferMethod { Rays, Raster };

template <>
struct EnumNames<GBufferMethod> {
    static constexpr std::array names{std::pair{GBufferMethod::Rays, "rays"},
                                      std::pair{GBufferMethod::Raster, "raster"}};
};

enum class TextureLookup { Filtered, Sharp };

template <>
struct EnumNames<TextureLookup> {
    static constexpr std::array names{std::pair{TextureLookup::Filtered, "filtered"},
                                      std::pair{TextureLookup::Sharp, "sharp"}};
};

/// How the camera looks at the image plane, as in view.glsl.
struct View {
    glm::vec3 origin;
    uint32_t width;
    glm::vec3 forward;
    uint32_t height;
    glm::vec3 right;
    glm::vec3 up;
};

namespace {

constexpr uint32_t kMaxBatchRays = 1u << 20;  // Bounds the memory of rays and hits to 48 MiB.
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
    return std::min<uint64_t>(uint64_t(extent.x) * extent.y, kMaxBatchRays);
}

}  // namespace

/// What the camera sees, by camera rays through the stream interface or by raster.
class GBufferPass final : public Pass {
 public:
    static constexpr const char* kName = "gbuffer";
    static constexpr const char* kHelp =
        "Writes the G-buffer: position, normals, albedo and emission. "
        "It holds what the camera sees, samples x samples a pixel. "
        "Biased at edges, where the reference averages over the pixel; less so the more samples.";
    struct Params {
        GBufferMethod method = GBufferMethod::Rays;
        uint32_t samplesPerPixelEdge = 1;
        TextureLookup normalMaps = TextureLookup::Filtered;
        TextureLookup colors = TextureLookup::Filtered;
        static constexpr auto schema() {
            return std::tuple{
                field("method", &Params::method,
                      "rays: camera rays, which meet the same surfaces as every other ray; "
                      "on a CPU a tenth of raster's time in a large scene. "
                      "raster: for GPUs whose rays are slow or missing."),
                field("samples_per_pixel_edge", &Params::samplesPerPixelEdge,
                      "Samples along each edge of a pixel: 2 takes 4 a pixel, on a regular grid. "
                      "Passes that read the g-buffer do their work for each.",
                      1u, 8u),
                field("normal_maps", &Params::normalMaps,
                      "filtered: the mean normal of a sample's footprint, "
                      "which is flatter than each of them: a bias. sharp: the normal at the very point: "
                      "noise instead, which samples_per_pixel_edge lowers."),
                field("colors", &Params::colors,
                      "filtered: the mean color of a sample's footprint, by mip levels. "
                      "sharp: the color at the very point: "
                      "patterns where texels are smaller than samples are apart, "
                      "as published in Magalhães 2020 (section 5.1.4), for comparison.")};
        }
    };

    explicit GBufferPass(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    void trace(PassContext& context);
    void rasterize(PassContext& context);
    void initMotion(PassContext& context);
    void computeMotion(PassContext& context);
    bool hasMotion(const PortAccess& access) const { return access[motion_].isRead; }

    const Params params_;
    Out<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    Out<SurfaceMotion> motion_{*this, "motion", "where it was in the frame before"};
    Kernel generateRays_{*this, "generate_camera_rays.comp"};           ///< Of rays.
    Kernel shade_{*this, "shade.comp"};                                 ///< Of rays.
    Buffer rays_, hits_;                                                ///< Of rays.
    Kernel background_{*this, "background.comp"};                       ///< Of raster.
    RasterPipeline surfaces_{*this, {"gbuffer.vert", "gbuffer.frag"}};  ///< Of raster.
    Image depth_;                                                       ///< Of raster.
    // Of motion, where it is read
    Kernel findMotion_{*this, "motion.comp"};
    LargeBuffer previousPositions_;  ///< Of vertices, m.
    Buffer instanceStarts_;          ///< First triangle of each mesh instance.
    struct Before {
        View view;
        uint64_t sceneVersion;  ///< Of previousPositions_.
    };
    std::optional<Before> previousFrame_;  ///< Of the last frame; none before the first one.
};

void GBufferPass::plan(PassPlan& plan) {
    GBuffer& g = plan[gbuffer_];
    g.samples = params_.samplesPerPixelEdge;
    const glm::uvec2 extent = gbufferExtent(plan.frame, params_.samplesPerPixelEdge);
    for (const Target& t : kTargets) plan.image(g.*t.image, t.name, targetDesc(extent, t.format));
    if (hasMotion(plan)) {
        const Geometry& geometry = plan.frame.scene->geometry;
        SurfaceMotion& motion = plan[motion_];
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

    Defines defines;
    if (params_.normalMaps == TextureLookup::Sharp) defines.emplace("SHARP_NORMALS", "1");
    if (params_.colors == TextureLookup::Sharp) defines.emplace("SHARP_COLORS", "1");
    if (hasMotion(plan)) defines.emplace("MOTION", "1");
    shade_.define(defines);
    surfaces_.define(defines);
    RasterState state;
    for (const Target& t : kTargets) state.colorFormats.push_back(t.format);
    if (hasMotion(plan)) state.colorFormats.push_back(kWide);
    state.depthFormat = VK_FORMAT_D32_SFLOAT;
    state.depthCompare = VK_COMPARE_OP_GREATER;
    surfaces_.setState(state);
    generateRays_.compileIf(params_.method == GBufferMethod::Rays);
    shade_.compileIf(params_.method == GBufferMethod::Rays);
    background_.compileIf(params_.method == GBufferMethod::Raster);
    surfaces_.compileIf(params_.method == GBufferMethod::Raster);
    findMotion_.compileIf(hasMotion(plan));
}

void GBufferPass::prepare(PassSetup& setup) {
    if (!hasMotion(setup)) return;
    std::vector<uint32_t> starts;
    for (const InstanceRange& range : setup.frame.scene->geometry.instances)
        starts.push_back(range.firstTriangle);
    setup.stream.upload(instanceStarts_, starts);
}

void GBufferPass::record(PassContext& context) {
    if (hasMotion(context)) initMotion(context);
    if (params_.method == GBufferMethod::Rays)
        trace(context);
    else
        rasterize(context);
    if (hasMotion(context)) computeMotion(context);
}

void GBufferPass::initMotion(PassContext& context) {
    if (previousFrame_) return;
    const glm::uvec2 extent = gbufferExtent(context.frame, params_.samplesPerPixelEdge);
    context.stream.copy(context.scene.positions, previousPositions_, previousPositions_.bytes());
    previousFrame_ = {viewOf(context.frame, extent), context.frame.sceneVersion};
}

void GBufferPass::computeMotion(PassContext& context) {
    const SurfaceMotion& motion = context[motion_];
    const glm::uvec2 extent = gbufferExtent(context.frame, params_.samplesPerPixelEdge);
    const View view = viewOf(context.frame, extent);
    context.dispatch(findMotion_, extent,
                     {context[gbuffer_],
                      {"previous", motion.previous},
                      {"motion", motion.motion},
                      {"view", view},
                      {"previousView", previousFrame_->view}});

    // For the next frame
    if (previousFrame_->sceneVersion != context.frame.sceneVersion)
        context.stream.copy(context.scene.positions, previousPositions_, previousPositions_.bytes());
    previousFrame_ = {view, context.frame.sceneVersion};
}

void GBufferPass::trace(PassContext& context) {
    const GBuffer& g = context[gbuffer_];
    const glm::uvec2 extent = gbufferExtent(context.frame, params_.samplesPerPixelEdge);
    const View view = viewOf(context.frame, extent);
    const uint32_t texels = extent.x * extent.y;
    for (uint32_t first = 0; first < texels; first += kMaxBatchRays) {
        const uint32_t batch = std::min(kMaxBatchRays, texels - first);
        context.dispatch(generateRays_, batch,
                         {{"rays", rays_}, {"view", view}, {"firstTexel", first}, {"batchRays", batch}});
        context.tracer.closestHit(context.stream, rays_, hits_, batch, Coherence::Coherent);
        context.dispatch(shade_, batch,
                         {context.scene,
                          g,
                          {"emitted", g.emission},
                          {"hits", hits_},
                          ifUsed({"previous", context[motion_].previous}),
                          ifUsed({"PreviousPositionsRef", previousPositions_.ref()}),
                          ifUsed({"instanceStarts", instanceStarts_}),
                          {"view", view},
                          {"firstTexel", first},
                          {"batchRays", batch}});
    }
}

void GBufferPass::rasterize(PassContext& context) {
    const GBuffer& g = context[gbuffer_];
    const Frame& frame = context.frame;
    const glm::uvec2 extent = gbufferExtent(frame, params_.samplesPerPixelEdge);
    const View view = viewOf(frame, extent);

    // The environment behind everything.
    context.dispatch(background_, extent, {context.scene, {"background", g.emission}, {"view", view}});

    // All triangles over it, with depth test.
    RasterTargets targets;
    for (const Target& t : kTargets) {
        targets.colors.push_back({&(g.*t.image), {}});
        if (t.cleared) targets.colors.back().clear = VkClearColorValue{};
    }
    if (hasMotion(context)) targets.colors.push_back({&context[motion_].previous, VkClearColorValue{}});
    targets.depth = &depth_;
    targets.depthClear = 0;
    targets.extent = {extent, 1};
    const Geometry& geometry = frame.scene->geometry;
    context.stream.draw(
        surfaces_, targets, context.scene.triangleCount * 3,
        {context.scene,
         ifUsed({"PreviousPositionsRef", previousPositions_.ref()}),
         ifUsed({"instanceStarts", instanceStarts_}),
         {"viewProjection", viewProjection(frame.camera, frame.width, frame.height, geometry)},
         {"view", view}});
}

VOXRAY_REGISTER_PASS(GBufferPass);

}  // namespace voxray
