#include <algorithm>
#include <optional>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/camera_matrix.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/view/surface_motion.h"
#include "passes/view/camera_view.h"
#include "passes/view/gbuffer/gbuffer_params.h"
#include "passes/view/scene_materials.h"
#include "vulkan/indirect.h"

namespace voxray {

namespace {

constexpr uint32_t kMaxBatchRays = 1u << 20;  // Bounds the memory of rays and hits to 48 MiB.
constexpr VkFormat kWide = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kHalf = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kByte = VK_FORMAT_R8G8B8A8_UNORM;

/// An image of the G-buffer.
struct Target {
    const char* name;
    Image GBuffer::*image;
    VkFormat format;
    bool isCleared;  ///< Before surfaces are drawn; otherwise it holds the environment.
};
/// In the order of gbuffer.frag's outputs.
constexpr Target kTargets[] = {{"gbuffer position", &GBuffer::position, kWide, true},
                               {"gbuffer normal", &GBuffer::normal, kHalf, true},
                               {"gbuffer geometric normal", &GBuffer::geometricNormal, kHalf, true},
                               {"gbuffer albedo", &GBuffer::albedo, kHalf, true},
                               {"gbuffer emission", &GBuffer::emission, kWide, false},
                               {"gbuffer specular", &GBuffer::specular, kHalf, true},
                               {"gbuffer fresnel", &GBuffer::fresnel, kByte, true}};

ImageDesc targetDesc(glm::uvec2 extent, VkFormat format) {
    ImageDesc desc{.format = format, .extent = {extent, 1}};
    desc.usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return desc;
}

uint64_t batchRays(glm::uvec2 extent) {
    return std::min<uint64_t>(uint64_t(extent.x) * extent.y, kMaxBatchRays);
}

}  // namespace

/// The G-buffer (Saito and Takahashi 1990), by camera rays through the stream interface or by rasterization.
class GBufferPass final : public Pass {
 public:
    static constexpr const char* kName = "gbuffer";
    static constexpr const char* kHelp =
        "Writes the G-buffer: position, normals and material of what the camera sees. "
        "Each pixel has a square of samples. "
        "Biased at edges, where the reference averages over the pixel; less so the more samples.";
    using Params = GBufferParams;

    explicit GBufferPass(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    void trace(PassContext& context);
    /// Stores what a batch of rays hit. @param range bindings of the kernels: view and rays.
    void storeHits(PassContext& context, uint32_t rays, const std::vector<Binding>& range);
    void rasterize(PassContext& context);
    void computeMotion(PassContext& context);
    /// Stores what the next frame's motion is relative to.
    void storeFrame(PassContext& context);
    CameraView viewOf(const Frame& frame) const {
        return cameraView(frame, gbufferExtent(frame, params_.samplesPerPixelEdge));
    }
    bool hasMotion(const PortAccess& access) const { return access[motion_].isRead; }
    bool sharesMaterials() const {
        return params_.materialsOf == MaterialsOf::Surfaces && params_.samplesPerPixelEdge > 1;
    }
    /// Whether surfaces without textures are stored by a program of their own: most of the scene has none.
    bool sortsHits() const {
        return !sharesMaterials() && materials_.textureKinds != 0 && materials_.texturedFraction < 0.5;
    }
    /// Rays whose hits are stored at once: those of whole pixels.
    uint32_t maxBatchRays() const {
        const uint32_t perPixel = params_.samplesPerPixelEdge * params_.samplesPerPixelEdge;
        return kMaxBatchRays / perPixel * perPixel;
    }

    const Params params_;
    Out<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    Out<SurfaceMotion> motion_{*this, "motion", "motion since the previous frame"};
    // With rays
    Kernel generateRays_{*this, "generate_camera_rays.comp"};
    Kernel storeSurfaces_{*this, "store_surfaces.comp"};
    Buffer rays_, hits_;
    SceneMaterials materials_;
    bool isCleared_ = false;  ///< Whether images that rays leave as they are hold zeros.
    // With materials of surfaces
    Kernel storePixels_{*this, "store_pixels.comp"};
    // With these, or where hits are sorted
    Kernel storeListed_{*this, "store_surfaces.comp"};
    Buffer listed_;  ///< Pixels with several surfaces, or rays, of a batch (shaders/compute/indirect_list.glsl).
    // With raster
    Kernel fillBackground_{*this, "background.comp"};
    RasterPipeline drawSurfaces_{*this, {"gbuffer.vert", "gbuffer.frag"}};
    Image depth_;
    // Where motion is read
    Kernel computeMotion_{*this, "motion.comp"};
    LargeBuffer previousPositions_;  ///< Of vertices, m.
    Buffer instanceStarts_;          ///< First triangle of each mesh instance.
    struct PreviousFrame {
        CameraView view;
        uint64_t sceneVersion;  ///< Of previousPositions_.
    };
    std::optional<PreviousFrame> previousFrame_;  ///< None in the first frame.
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
        plan.image(depth_, "gbuffer depth",
                   {.format = VK_FORMAT_D32_SFLOAT,
                    .extent = {extent, 1},
                    .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT});
    } else {
        plan.buffer(rays_, "camera rays", batchRays(extent) * sizeof(Ray));
        plan.buffer(hits_, "camera ray hits", batchRays(extent) * sizeof(Hit));
    }
    materials_ = sceneMaterials(*plan.frame.scene);
    isCleared_ = false;
    if (sharesMaterials()) {
        if (params_.normalMaps == TextureLookup::Sharp || params_.colors == TextureLookup::Sharp)
            throw Error(
                "gbuffer: 'materials_of: surfaces' filters textures over the pixel, so that 'normal_maps' and 'colors' "
                "can't be sharp; set 'materials_of: samples'");
        plan.buffer(listed_, "pixels with several surfaces",
                    sizeof(uint32_t) * (4 + batchRays(extent) / (g.samples * g.samples)));
    } else if (params_.method == GBufferMethod::Rays && sortsHits()) {
        plan.buffer(listed_, "rays that hit textures", sizeof(uint32_t) * (4 + batchRays(extent)));
    }

    Defines defines{{"TEXTURE_KINDS", std::to_string(materials_.textureKinds) + "u"}};
    if (params_.normalMaps == TextureLookup::Sharp) defines.emplace("SHARP_NORMALS", "1");
    if (params_.colors == TextureLookup::Sharp) defines.emplace("SHARP_COLORS", "1");
    if (hasMotion(plan)) defines.emplace("MOTION", "1");
    drawSurfaces_.define(defines);
    if (params_.samplePattern == SamplePattern::Rotated) defines.emplace("ROTATED_GRID", "1");
    if (params_.samplePattern == SamplePattern::Random) defines.emplace("RANDOM_POINTS", "1");
    if (materials_.areLambert) defines.emplace("LAMBERT", "1");
    if (materials_.isDark) defines.emplace("DARK", "1");
    defines.emplace("SAMPLES", std::to_string(params_.samplesPerPixelEdge));
    const bool hasRays = params_.method == GBufferMethod::Rays;
    for (Kernel* kernel : {&generateRays_, &storePixels_}) kernel->define(defines);
    Defines listing = defines, listed = defines;
    if (sortsHits()) {
        listing.emplace("LISTS_TEXTURED", "1");
        listing["TEXTURE_KINDS"] = "0u";
    }
    listed.emplace("LISTED", sharesMaterials() ? "TEXELS" : "1");
    storeSurfaces_.define(listing);
    storeListed_.define(listed);
    generateRays_.compileIf(hasRays);
    storeSurfaces_.compileIf(hasRays && !sharesMaterials());
    storePixels_.compileIf(hasRays && sharesMaterials());
    storeListed_.compileIf(hasRays && (sharesMaterials() || sortsHits()));
    RasterState state;
    for (const Target& t : kTargets) state.colorFormats.push_back(t.format);
    if (hasMotion(plan)) state.colorFormats.push_back(kWide);
    state.depthFormat = VK_FORMAT_D32_SFLOAT;
    state.depthCompare = VK_COMPARE_OP_GREATER;
    drawSurfaces_.setState(state);
    fillBackground_.compileIf(params_.method == GBufferMethod::Raster);
    drawSurfaces_.compileIf(params_.method == GBufferMethod::Raster);
    computeMotion_.compileIf(hasMotion(plan));
}

void GBufferPass::prepare(PassSetup& setup) {
    if (!hasMotion(setup)) return;
    std::vector<uint32_t> starts;
    for (const InstanceRange& range : setup.frame.scene->geometry.instances) starts.push_back(range.firstTriangle);
    setup.stream.upload(instanceStarts_, starts);
}

void GBufferPass::record(PassContext& context) {
    if (hasMotion(context) && !previousFrame_) storeFrame(context);
    if (params_.method == GBufferMethod::Rays)
        trace(context);
    else
        rasterize(context);
    if (!hasMotion(context)) return;
    computeMotion(context);
    storeFrame(context);
}

void GBufferPass::computeMotion(PassContext& context) {
    const SurfaceMotion& motion = context[motion_];
    context.dispatch(computeMotion_, gbufferExtent(context.frame, params_.samplesPerPixelEdge),
                     {context[gbuffer_],
                      {"previous", motion.previous},
                      {"motion", motion.motion},
                      {"view", viewOf(context.frame)},
                      {"previousView", previousFrame_->view}});
}

void GBufferPass::storeFrame(PassContext& context) {
    if (!previousFrame_ || previousFrame_->sceneVersion != context.frame.sceneVersion)
        context.stream.copy(context.scene.positions, previousPositions_, previousPositions_.bytes());
    previousFrame_ = {viewOf(context.frame), context.frame.sceneVersion};
}

void GBufferPass::trace(PassContext& context) {
    if (!isCleared_) {
        const GBuffer& g = context[gbuffer_];
        if (materials_.areLambert)
            for (const Image* image : {&g.specular, &g.fresnel}) context.stream.clear(*image, {});
        if (materials_.isDark) context.stream.clear(g.emission, {});
        isCleared_ = true;
    }
    const CameraView view = viewOf(context.frame);
    const uint32_t texels = view.width * view.height, seed = randomSeed(context.frame, context.frameIndex);
    for (uint32_t first = 0; first < texels; first += maxBatchRays()) {
        const uint32_t batch = std::min(maxBatchRays(), texels - first);
        const std::vector<Binding> range{
            {"view", view}, ifUsed({"seed", seed}), {"firstRay", first}, ifUsed({"batchRays", batch})};
        context.dispatch(generateRays_, batch, {{"rays", rays_}, range});
        context.tracer.closestHit(context.stream, rays_, hits_, batch, Coherence::Coherent);
        storeHits(context, batch, range);
    }
}

void GBufferPass::storeHits(PassContext& context, uint32_t rays, const std::vector<Binding>& range) {
    const GBuffer& g = context[gbuffer_];
    const Bindings bindings{context.scene,
                            g,
                            ifUsed({"emitted", g.emission}),
                            {"hits", hits_},
                            ifUsed({"previous", context[motion_].previous}),
                            ifUsed({"PreviousPositionsRef", previousPositions_.ref()}),
                            ifUsed({"instanceStarts", instanceStarts_}),
                            ifUsed({"indirectList", listed_}),
                            range};
    if (!sharesMaterials() && !sortsHits()) return context.dispatch(storeSurfaces_, rays, bindings);
    context.stream.fill(listed_, 1);
    if (sharesMaterials())
        context.dispatch(storePixels_, rays / (g.samples * g.samples), bindings);
    else
        context.dispatch(storeSurfaces_, rays, bindings);
    dispatchIndirect(context.stream, storeListed_, listed_, 0, bindings);
}

void GBufferPass::rasterize(PassContext& context) {
    const GBuffer& g = context[gbuffer_];
    const Frame& frame = context.frame;
    const glm::uvec2 extent = gbufferExtent(frame, params_.samplesPerPixelEdge);
    const CameraView view = viewOf(frame);

    // Fill the background with the environment
    context.dispatch(fillBackground_, extent, {context.scene, {"background", g.emission}, {"view", view}});

    // Draw all triangles over it, with depth test
    RasterTargets targets;
    for (const Target& t : kTargets) {
        targets.colors.push_back({&(g.*t.image), {}});
        if (t.isCleared) targets.colors.back().clear = VkClearColorValue{};
    }
    if (hasMotion(context)) targets.colors.push_back({&context[motion_].previous, VkClearColorValue{}});
    targets.depth = &depth_;
    targets.depthClear = 0;
    targets.extent = {extent, 1};
    const Geometry& geometry = frame.scene->geometry;
    context.stream.draw(drawSurfaces_, targets, context.scene.triangleCount * 3,
                        {context.scene,
                         ifUsed({"PreviousPositionsRef", previousPositions_.ref()}),
                         ifUsed({"instanceStarts", instanceStarts_}),
                         {"viewProjection", viewProjection(frame.camera, frame.width, frame.height, geometry)},
                         {"view", view}});
}

VOXRAY_REGISTER_PASS(GBufferPass);

}  // namespace voxray
