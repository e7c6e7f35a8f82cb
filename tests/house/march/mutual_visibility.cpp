#include "tests/house/march/mutual_visibility.h"

namespace voxray {
namespace {

struct Push {
    gpu::VoxelGrid grid;
    glm::uvec2 pixel;
};

}  // namespace

void MutualVisibility::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees, a texel a pixel");
    voxels_ = builder.read<SurfaceVoxels>("voxels", "what hides surfaces from each other");
    seen_ = builder.write<FrameImage>("seen", "1 or 0");
}

void MutualVisibility::plan(PassPlan& plan) {
    march_.plan(plan, plan.get(voxels_));
    plan.image(plan.get(seen_).image, "seen", frameImageDesc(plan.frame));
}

void MutualVisibility::prepare(PassSetup& setup) {
    march_.prepare(setup.device, setup.compiler);
    program_ = makeComputeProgram(
        setup.device, setup.compiler.compile("tests/house/march/mutual_visibility.comp", march_.defines()));
    sampler_ = texelSampler(setup.device);
}

void MutualVisibility::record(PassContext& context) {
    const GBuffer& gbuffer = context.get(gbuffer_);
    const SurfaceVoxels& voxels = context.get(voxels_);
    march_.begin(context.stream, voxels);
    std::vector<Binding> bindings = march_.bindings();
    bindings.insert(bindings.end(), {{"position", gbuffer.position, sampler_},
                                     {"geometricNormal", gbuffer.geometricNormal, sampler_},
                                     {"seen", context.get(seen_).image}});
    context.stream.dispatch(program_, bindings, Push{voxels.grid, {params_.x, params_.y}},
                            {(context.frame.width + 7) / 8, (context.frame.height + 7) / 8, 1});
    context.voxelCounts.push_back(&march_.counts());
}

}  // namespace voxray
