#include "passes/gather_cones/gather_cones.h"

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct TracePush {
    uint32_t cones;
    uint32_t stride;
};

struct ResolvePush {
    uint32_t samples;
    uint32_t stride;
    float voxelSize;
};

/// One texel for each traced texel of the g-buffer, row by row.
ImageDesc tracedImage(const Frame& frame, uint32_t samples, uint32_t stride) {
    ImageDesc desc = frameImageDesc(frame);
    const glm::uvec2 extent = gbufferExtent(frame, samples);
    desc.extent = {(extent.x + stride - 1) / stride, extent.y, 1};
    return desc;
}

}  // namespace

void GatherCones::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    radiance_ = builder.read<RadianceVoxels>("radiance", "light that leaves surfaces, at all scales");
    indirect_ = builder.write<FrameImage>("indirect", "radiance reflected of indirect light");
    if (params_.specular > 0)
        lobes_ = builder.write<SpecularLobes>(
            "lobes", "what specular lobes reflect; a pass that reads it joins it with 'indirect'");
}

void GatherCones::plan(PassPlan& plan) {
    plan.buffer(cones_, "cones", coneSet(params_.cones).size() * sizeof(gpu::Cone));
    plan.get(indirect_).lightBounces = plan.get(radiance_).lightBounces;
    plan.get(indirect_).hasSpecularLobes = params_.specular > 0;
    plan.image(plan.get(indirect_).image, "indirect", frameImageDesc(plan.frame));
    const ImageDesc traced = tracedImage(plan.frame, plan.get(gbuffer_).samples, params_.stride);
    plan.image(irradiance_, "gathered irradiance", traced);
    if (hasNearField()) {
        if (plan.get(radiance_).emission)
            throw Error(
                "gather_cones: 'near_field_voxels' measures light at near hits without what they emit, which "
                "the radiance voxels hold; set it to 0, or 'emission' of filter_voxels to false");
        near_.plan(plan, {params_.nearFieldVoxels, params_.cones, params_.stride, traced.extent,
                          coneSet(params_.cones).back().width});
    }
    if (params_.specular == 0) return;
    SpecularLobes& lobes = plan.get(lobes_);
    lobes.isJoined = false;
    lobes.emission = plan.get(radiance_).emission;
    specular_.plan(plan, plan.get(gbuffer_), params_.specular, lobes.reflected);
}

void GatherCones::prepare(PassSetup& setup) {
    const RadianceVoxels& radiance = setup.get(radiance_);
    const auto program = [&](const char* file, const Defines& defines) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    if (hasNearField())
        near_.prepare(setup, radiance);
    else
        trace_ = program("passes/gather_cones/trace.comp", radiance.defines());
    resolve_ = program("passes/gather_cones/resolve.comp",
                       reflectsLobes(setup) ? Defines{{"SPECULAR", "1"}} : Defines{});
    if (params_.specular > 0) specular_.prepare(setup, radiance);
    sampler_ = texelSampler(setup.device);
    setup.stream.upload(cones_, coneSet(params_.cones));
}

void GatherCones::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const RadianceVoxels& radiance = context.get(radiance_);
    if (hasNearField())
        near_.record(context, gbuffer, radiance, cones_, irradiance_);
    else
        trace(context, gbuffer, radiance);
    std::vector<Binding> seen{{"irradiance", irradiance_, sampler_},
                              {"albedo", gbuffer.albedo, sampler_},
                              {"position", gbuffer.position, sampler_},
                              {"normal", gbuffer.normal, sampler_},
                              {"result", context.get(indirect_).image}};
    if (params_.specular > 0) {
        const Image& reflected = context.get(lobes_).reflected;
        specular_.record(context, gbuffer, radiance, reflected);
        if (reflectsLobes(context)) seen.emplace_back("reflected", reflected, sampler_);
    }
    context.stream.dispatch(resolve_, seen,
                            ResolvePush{gbuffer.samples, params_.stride, radiance.grid.voxelSize},
                            pixelGroups(context.frame.width, context.frame.height));
}

void GatherCones::trace(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance) const {
    std::vector<Binding> bindings = radiance.bindings();
    bindings.emplace_back("cones", cones_);
    bindings.emplace_back("position", gbuffer.position, sampler_);
    bindings.emplace_back("normal", gbuffer.normal, sampler_);
    bindings.emplace_back("geometricNormal", gbuffer.geometricNormal, sampler_);
    bindings.emplace_back("irradiance", irradiance_);
    const glm::uvec3 texels = irradiance_.desc().extent;
    context.stream.dispatch(trace_, bindings, TracePush{params_.cones, params_.stride},
                            pixelGroups(texels.x, texels.y));
}

}  // namespace voxray
