#include "passes/gather_cones/specular_cones.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/view/frame_image.h"
#include "passes/gather_cones/lobe_types.h"

namespace voxray {
namespace {

constexpr uint32_t kPoints = 1024;  // Of all integrals of a lobe together: their error is below 0.002.

struct TablePush {
    uint32_t strata;
    uint32_t points;
};

struct SpecularTracePush {
    glm::vec3 camera;
    uint32_t strata;
};

ImageDesc reflectedImage(const Frame& frame, const GBuffer& gbuffer) {
    ImageDesc desc = frameImageDesc(frame);
    desc.extent = {gbufferExtent(frame, gbuffer.samples), 1};
    return desc;
}

}  // namespace

void SpecularCones::plan(PassPlan& plan, const GBuffer& gbuffer, uint32_t strata, Image& reflected) {
    strata_ = strata;
    plan.buffer(table_, "specular lobes", uint64_t(LOBES) * strata * sizeof(gpu::LobeStratum));
    plan.image(reflected, "specular reflection", reflectedImage(plan.frame, gbuffer));
}

void SpecularCones::prepare(PassSetup& setup, const RadianceVoxels& radiance) {
    const auto program = [&](const char* file, const Defines& defines) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    trace_ = program("passes/gather_cones/specular.comp", radiance.defines());
    sampler_ = texelSampler(setup.device);

    // The table depends on nothing but its size.
    const Program fill = program("passes/gather_cones/lobe_table.comp", {});
    setup.stream.dispatch(fill, {{"strata", table_}}, TablePush{strata_, kPoints / strata_},
                          linearGroups(uint64_t(LOBES) * strata_));
    setup.stream.finish();
}

void SpecularCones::record(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance,
                           const Image& reflected) const {
    std::vector<Binding> bindings = radiance.bindings();
    bindings.insert(bindings.end(), {{"position", gbuffer.position, sampler_},
                                     {"normal", gbuffer.normal, sampler_},
                                     {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                     {"specular", gbuffer.specular, sampler_},
                                     {"fresnel", gbuffer.fresnel, sampler_},
                                     {"strata", table_},
                                     {"reflected", reflected}});
    const glm::uvec3 texels = reflected.desc().extent;
    context.stream.dispatch(trace_, bindings, SpecularTracePush{context.frame.camera.position, strata_},
                            pixelGroups(texels.x, texels.y));
}

}  // namespace voxray
