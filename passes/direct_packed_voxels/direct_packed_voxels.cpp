#include "passes/direct_packed_voxels/direct_packed_voxels.h"

#include "passes/common/compute/dispatch.h"
#include "passes/common/view/frame_image.h"

namespace voxray {
namespace {

struct DirectPush {
    gpu::VoxelGrid grid;
    float white;
    uint32_t samples;
};

}  // namespace

void DirectPackedVoxels::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    voxels_ = builder.read<PackedVoxels>("packed_voxels", "the voxels that hold the light");
    light_ = builder.read<PackedLight>("packed_light", "light that arrives in voxels, one word a voxel");
    direct_ = builder.write<FrameImage>("direct", "radiance reflected of the light in voxels");
}

void DirectPackedVoxels::plan(PassPlan& plan) {
    plan.get(direct_).lightBounces = plan.get(light_).lightBounces;
    plan.image(plan.get(direct_).image, "direct", frameImageDesc(plan.frame));
}

void DirectPackedVoxels::prepare(PassSetup& setup) {
    program_ = makeComputeProgram(
        setup.device, setup.compiler.compile("passes/direct_packed_voxels/direct_packed_voxels.comp"),
        SpecializationConstants{{"kSevenTap", params_.lookup == PackedLookup::SevenTap}});
    sampler_ = texelSampler(setup.device);
}

void DirectPackedVoxels::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const PackedLight& light = context.get(light_);
    context.stream.dispatch(program_,
                            {{"position", gbuffer.position, sampler_},
                             {"albedo", gbuffer.albedo, sampler_},
                             {"IrradianceAt", light.irradiance.at()},
                             {"result", context.get(direct_).image}},
                            DirectPush{context.get(voxels_).grid, light.white, gbuffer.samples},
                            pixelGroups(context.frame.width, context.frame.height));
}

}  // namespace voxray
