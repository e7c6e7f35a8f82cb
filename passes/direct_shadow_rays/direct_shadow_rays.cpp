#include "passes/direct_shadow_rays/direct_shadow_rays.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;  // Bounds the memory of rays and what they carry to 52 MiB.
enum TargetKind : uint32_t { kPunctual = 0, kEmitters = 1, kEnvironment = 2 };  // As in aim.comp.

struct AimPush {
    uint32_t kind;
    uint32_t light;  ///< Index of a punctual light, else the number of the sample.
    uint32_t lightSamples;
    uint32_t width;
    uint32_t firstPixel;
    uint32_t batchRays;
    uint32_t samples;
    uint32_t seed;
    uint32_t emitterCount;
    glm::vec3 camera;
    gpu::VoxelGrid grid;
};

struct AddPush {
    uint32_t width;
    uint32_t firstPixel;
    uint32_t batchPixels;
    uint32_t raysPerPixel;
};

/// Pixels whose rays are traced together.
uint32_t batchPixels(const Frame& frame, const GBuffer& gbuffer) {
    return std::min(frame.width * frame.height, kBatchRays / (gbuffer.samples * gbuffer.samples));
}

}  // namespace

void DirectShadowRays::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    if (params_.visibility == Visibility::Voxels)
        voxels_ = builder.read<SurfaceVoxels>("voxels", "what shadow rays meet");
    direct_ = builder.write<FrameImage>("direct", "radiance reflected of direct light");
}

void DirectShadowRays::plan(PassPlan& plan) {
    const GBuffer& gbuffer = plan.get(gbuffer_);
    const uint64_t rays = batchPixels(plan.frame, gbuffer) * gbuffer.samples * gbuffer.samples;
    plan.buffer(rays_, "shadow rays", rays * sizeof(Ray));
    plan.buffer(carried_, "shadow ray radiance", rays * 4 * sizeof(float));
    plan.buffer(occluded_, "shadow ray results", rays * sizeof(uint32_t));
    tint_.plan(plan, rays);
    plan.lightRays = uint64_t(plan.frame.width) * plan.frame.height * gbuffer.samples * gbuffer.samples *
                     plan.frame.scene->lights.size();
    plan.image(plan.get(direct_).image, "direct", frameImageDesc(plan.frame));
    if (params_.visibility == Visibility::Voxels) voxelTracer_.plan(plan, plan.get(voxels_));
}

void DirectShadowRays::prepare(PassSetup& setup) {
    aim_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/direct_shadow_rays/aim.comp"),
                              {{"kMeetVoxels", params_.visibility == Visibility::Voxels}});
    add_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/direct_shadow_rays/add.comp"));
    sampler_ = texelSampler(setup.device);
    tint_.prepare(setup);
    if (params_.visibility == Visibility::Voxels) voxelTracer_.prepare(setup.device, setup.compiler);
}

void DirectShadowRays::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const Image& direct = context.get(direct_).image;
    CommandStream& stream = context.stream;
    const Frame& frame = context.frame;
    const uint32_t pixels = frame.width * frame.height;
    const uint32_t batch = batchPixels(frame, gbuffer), perPixel = gbuffer.samples * gbuffer.samples;
    const uint32_t seed = randomSeed(frame, context.frameIndex);
    stream.clear(direct, {});
    RayTracer* tracer = &context.tracer;
    gpu::VoxelGrid grid{};
    if (params_.visibility == Visibility::Voxels) {
        const SurfaceVoxels& voxels = context.get(voxels_);
        grid = voxels.grid;
        voxelTracer_.begin(stream, voxels);
        tracer = &voxelTracer_;
    }
    const uint64_t raysBefore = tracer->raysTraced();

    // A stream of shadow rays for each light, or for each sample of the emissive surfaces and the
    // environment.
    const auto shadowRays = [&](TargetKind kind, uint32_t light) {
        for (uint32_t first = 0; first < pixels; first += batch) {
            const uint32_t count = std::min(batch, pixels - first), rays = count * perPixel;
            stream.dispatch(
                aim_,
                context.scene.bindings({{"position", gbuffer.position, sampler_},
                                        {"normal", gbuffer.normal, sampler_},
                                        {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                        {"albedo", gbuffer.albedo, sampler_},
                                        {"specular", gbuffer.specular, sampler_},
                                        {"fresnel", gbuffer.fresnel, sampler_},
                                        {"rays", rays_},
                                        {"carried", carried_}}),
                AimPush{kind, light, params_.lightSamples, frame.width, first, rays, gbuffer.samples, seed,
                        context.scene.emitterCount, frame.camera.position, grid},
                linearGroups(rays));
            tracer->occluded(stream, rays_, occluded_, rays,
                             kind == kPunctual ? Coherence::Coherent : Coherence::Incoherent);
            tint_.apply(context, rays_, carried_, 4, rays);
            stream.dispatch(add_, {{"carried", carried_}, {"occluded", occluded_}, {"direct", direct}},
                            AddPush{frame.width, first, count, perPixel}, linearGroups(count));
        }
    };
    for (uint32_t light = 0; light < context.scene.lightCount; ++light) shadowRays(kPunctual, light);
    for (uint32_t s = 0; s < params_.lightSamples; ++s) {
        if (context.scene.emitterCount > 0) shadowRays(kEmitters, s);
        if (context.scene.hasEnvironment) shadowRays(kEnvironment, s);
    }
    if (params_.visibility == Visibility::Voxels) {
        context.extraRays += tracer->raysTraced() - raysBefore;
        context.voxelCounts.push_back(&voxelTracer_.march().counts());
    }
}

}  // namespace voxray
