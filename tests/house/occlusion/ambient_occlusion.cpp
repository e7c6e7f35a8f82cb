#include "tests/house/occlusion/ambient_occlusion.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 16;  // Bounds rays and answers to 2.3 MiB, whatever the image.

struct Push {
    uint32_t width;
    uint32_t firstPixel;
    uint32_t pixels;
    uint32_t samples;
    uint32_t raysPerTexel;
    float radius;
    uint32_t seed;
    glm::vec3 ambient;
};

}  // namespace

void AmbientOcclusion::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of ambient light");
}

uint32_t AmbientOcclusion::batchPixels(const Frame& frame, const GBuffer& gbuffer) const {
    return std::clamp(kBatchRays / raysPerPixel(gbuffer), 1u, frame.width * frame.height);
}

void AmbientOcclusion::plan(PassPlan& plan) {
    const GBuffer& gbuffer = plan.get(gbuffer_);
    const uint64_t rays = uint64_t(batchPixels(plan.frame, gbuffer)) * raysPerPixel(gbuffer);
    plan.scratchBuffer(rays_, "ambient rays", rays * sizeof(Ray));
    plan.scratchBuffer(occluded_, "ambient rays' answers", rays * sizeof(uint32_t));
    plan.image(plan.get(indirect_).image, "ambient light", frameImageDesc(plan.frame));
}

void AmbientOcclusion::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    aim_ = program("tests/house/occlusion/aim.comp");
    average_ = program("tests/house/occlusion/average.comp");
    sampler_ = texelSampler(setup.device);
}

void AmbientOcclusion::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const uint32_t width = context.frame.width, pixels = width * context.frame.height;
    const uint32_t batch = batchPixels(context.frame, gbuffer);
    const uint32_t seed = randomSeed(context.frame, context.frameIndex);
    for (uint32_t first = 0; first < pixels; first += batch) {
        const uint32_t count = std::min(batch, pixels - first), rays = count * raysPerPixel(gbuffer);
        const Push push{width,        first,          count, gbuffer.samples,
                        params_.rays, params_.radius, seed,  params_.ambient};
        context.stream.dispatch(
            aim_,
            context.scene.bindings({{"position", gbuffer.position, sampler_},
                                    {"normal", gbuffer.normal, sampler_},
                                    {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                    {"rays", rays_}}),
            push, linearGroups(rays));
        context.tracer.occluded(context.stream, rays_, occluded_, rays);
        context.stream.dispatch(average_,
                                {{"albedo", gbuffer.albedo, sampler_},
                                 {"rays", rays_},
                                 {"occluded", occluded_},
                                 {"indirect", context.get(indirect_).image}},
                                push, linearGroups(count));
    }
}

}  // namespace voxray
