#include "passes/accumulate/accumulate.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct AccumulatePush {
    float history;
    float clamp;
    uint32_t hasHistory;
    uint32_t spacing;
};

ImageDesc descOf(glm::uvec2 extent, VkFormat format) {
    ImageDesc desc;
    desc.format = format;
    desc.extent = {extent, 1};
    return desc;
}

}  // namespace

void Accumulate::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    motion_ = builder.read<SurfaceMotion>("motion", "where it was in the frame before");
    noisy_ = builder.read<NoisyIrradiance>("noisy_irradiance", "irradiance of this frame");
    accumulated_ = builder.write<NoisyIrradiance>("noisy_irradiance", "irradiance of these frames");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of it");
}

void Accumulate::plan(PassPlan& plan) {
    const NoisyIrradiance& noisy = plan.get(noisy_);
    const uint32_t samples = plan.get(gbuffer_).samples;
    const glm::uvec2 texels = gbufferExtent(plan.frame, samples);
    constexpr VkFormat kWide = VK_FORMAT_R32G32B32A32_SFLOAT;

    NoisyIrradiance& result = plan.get(accumulated_);
    result.lightBounces = noisy.lightBounces;
    result.spacing = noisy.spacing;
    result.blockSize = noisy.blockSize;
    plan.image(result.irradiance, "accumulated irradiance", NoisyIrradiance::desc(plan.frame, samples));
    if (noisy.blockSize > 0) plan.buffer(result.moments, "moments of rays", noisy.momentsBytes(texels));
    FrameImage& indirect = plan.get(indirect_);
    indirect.lightBounces = noisy.lightBounces;
    if (indirect.isRead) plan.image(indirect.image, "accumulated indirect", frameImageDesc(plan.frame));

    plan.image(frames_, "length of history", descOf(texels, VK_FORMAT_R32_SFLOAT));
    plan.image(historyLight_, "history of irradiance", descOf(texels, kWide));
    plan.image(historyPosition_, "history of positions", descOf(texels, kWide));
    plan.image(historyNormal_, "history of normals", descOf(texels, VK_FORMAT_R16G16B16A16_SFLOAT));
    if (params_.clamp == 0) return;
    const glm::uvec2 cells = (texels + noisy.spacing - 1u) / noisy.spacing;
    plan.image(cellLight_, "light of cells", descOf(cells, kWide));
    plan.image(cellSurface_, "surfaces of cells", descOf(cells, kWide));
}

void Accumulate::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    if (params_.clamp > 0) findCells_ = program("passes/accumulate/cells.comp");
    accumulate_ = makeComputeProgram(
        setup.device, setup.compiler.compile("passes/accumulate/accumulate.comp",
                                             params_.clamp > 0 ? Defines{{"CLAMP", "1"}} : Defines{}));
    keep_ = program("passes/accumulate/keep.comp");
    resolve_ = IrradianceResolve(setup);
    sampler_ = texelSampler(setup.device);
    hasHistory_ = false;
}

void Accumulate::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const SurfaceMotion& motion = context.get(motion_);
    const NoisyIrradiance& noisy = context.get(noisy_);
    const NoisyIrradiance& result = context.get(accumulated_);
    const glm::uvec3 texels = result.irradiance.desc().extent;
    CommandStream& stream = context.stream;
    std::vector<Binding> bindings{{"irradiance", noisy.irradiance, sampler_},
                                  {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                  {"motion", motion.motion, sampler_},
                                  {"previous", motion.previous, sampler_},
                                  {"historyLight", historyLight_, sampler_},
                                  {"historyPosition", historyPosition_, sampler_},
                                  {"historyNormal", historyNormal_, sampler_},
                                  {"result", result.irradiance},
                                  {"frames", frames_}};

    // What this frame's surroundings hold
    if (params_.clamp > 0) {
        const glm::uvec3 cells = cellLight_.desc().extent;
        stream.dispatch(findCells_,
                        {{"irradiance", noisy.irradiance, sampler_},
                         {"geometricNormal", gbuffer.geometricNormal, sampler_},
                         {"previous", motion.previous, sampler_},
                         {"cellLight", cellLight_},
                         {"cellSurface", cellSurface_}},
                        noisy.spacing, pixelGroups(cells.x, cells.y));
        bindings.emplace_back("cellLight", cellLight_, sampler_);
        bindings.emplace_back("cellSurface", cellSurface_, sampler_);
    }

    // This frame and those before it
    stream.dispatch(accumulate_, bindings,
                    AccumulatePush{float(params_.history), params_.clamp, hasHistory_, noisy.spacing},
                    pixelGroups(texels.x, texels.y));

    // For the next frame
    stream.dispatch(keep_,
                    {{"result", result.irradiance, sampler_},
                     {"frames", frames_, sampler_},
                     {"position", gbuffer.position, sampler_},
                     {"geometricNormal", gbuffer.geometricNormal, sampler_},
                     {"previous", motion.previous, sampler_},
                     {"historyLight", historyLight_},
                     {"historyPosition", historyPosition_},
                     {"historyNormal", historyNormal_}},
                    {}, pixelGroups(texels.x, texels.y));
    hasHistory_ = true;

    // The variance of a ray is this frame's: it does not depend on how many there are
    if (noisy.blockSize > 0) stream.copy(noisy.moments, result.moments, result.moments.bytes());
    if (const FrameImage& indirect = context.get(indirect_); indirect.isRead)
        resolve_.record(context, gbuffer, result.irradiance, indirect.image);
}

}  // namespace voxray
