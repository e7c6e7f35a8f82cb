#include "passes/direct_shadow_rays/direct_shadow_rays.h"

#include "passes/common/dispatch.h"
#include "passes/common/frame_image.h"

namespace voxray {
namespace {

enum TargetKind : uint32_t { kPunctual = 0, kEmitters = 1, kEnvironment = 2 };  // As in aim.comp.

struct AimPush {
    uint32_t kind;
    uint32_t light;  ///< Index of a punctual light, else the number of the sample.
    uint32_t samples;
    uint32_t width;
    uint32_t height;
    uint32_t seed;
    uint32_t emitterCount;
};

struct AddPush {
    uint32_t width;
    uint32_t height;
};

}  // namespace

void DirectShadowRays::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    direct_ = builder.write<FrameImage>("direct", "radiance reflected of direct light");
}

void DirectShadowRays::plan(PassPlan& plan) {
    const uint64_t pixels = uint64_t(plan.frame.width) * plan.frame.height;
    plan.reserve("shadow rays", pixels * (sizeof(Ray) + 4 * sizeof(float) + sizeof(uint32_t)));
    plan.reserve("direct image", imageBytes(frameImageDesc(plan.frame)));
}

void DirectShadowRays::prepare(PassSetup& setup) {
    const uint64_t pixels = uint64_t(setup.frame.width) * setup.frame.height;
    rays_ = Buffer(setup.device, "shadow rays", pixels * sizeof(Ray));
    carried_ = Buffer(setup.device, "shadow ray radiance", pixels * 4 * sizeof(float));
    occluded_ = Buffer(setup.device, "shadow ray results", pixels * sizeof(uint32_t));
    setup.get(direct_).image = Image(setup.device, "direct", frameImageDesc(setup.frame));
    aim_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/direct_shadow_rays/aim.comp"));
    add_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/direct_shadow_rays/add.comp"));
    sampler_ = texelSampler(setup.device);
}

void DirectShadowRays::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const Image& direct = context.get(direct_).image;
    CommandStream& stream = context.stream;
    const Frame& frame = context.frame;
    const uint32_t pixels = frame.width * frame.height;
    stream.clear(direct, {});

    // One stream of shadow rays for each light, or for each sample of the emissive surfaces and the
    // environment.
    const auto shadowRays = [&](TargetKind kind, uint32_t light) {
        const uint32_t seed = uint32_t(frame.seed * 0x9e3779b9u) + context.frameIndex * 0x85ebca6bu;
        stream.dispatch(aim_,
                        context.scene.bindings({{"position", gbuffer.position, sampler_},
                                                {"normal", gbuffer.normal, sampler_},
                                                {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                                {"albedo", gbuffer.albedo, sampler_},
                                                {"rays", rays_},
                                                {"carried", carried_}}),
                        AimPush{kind, light, params_.samples, frame.width, frame.height, seed,
                                context.scene.emitterCount},
                        pixelGroups(frame.width, frame.height));
        context.tracer.occluded(stream, rays_, occluded_, pixels);
        stream.dispatch(add_, {{"carried", carried_}, {"occluded", occluded_}, {"direct", direct}},
                        AddPush{frame.width, frame.height}, pixelGroups(frame.width, frame.height));
    };
    for (uint32_t light = 0; light < context.scene.lightCount; ++light) shadowRays(kPunctual, light);
    for (uint32_t s = 0; s < params_.samples; ++s) {
        if (context.scene.emitterCount > 0) shadowRays(kEmitters, s);
        if (context.scene.hasEnvironment) shadowRays(kEnvironment, s);
    }
}

}  // namespace voxray
