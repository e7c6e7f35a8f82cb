#include "tests/house/template/tint.h"

namespace voxray {

void Tint::declare(PassBuilder& builder) {
    source_ = builder.read<FrameImage>("source", "Image to tint.");
    final_ = builder.write<FrameImage>("final", "The tinted image.");
}

void Tint::plan(PassPlan& plan) {
    ImageDesc desc;
    desc.extent = {plan.frame.width, plan.frame.height, 1};
    plan.image(plan.get(final_).image, "tinted image", desc);
}

void Tint::prepare(PassSetup& setup) {
    program_ = makeComputeProgram(setup.device, setup.compiler.compile("tests/house/template/tint.comp"));
}

void Tint::record(PassContext& context) {
    const Image& target = context.get(final_).image;
    const glm::uvec3 pixels = target.desc().extent;
    context.stream.dispatch(program_, {{"source", context.get(source_).image}, {"target", target}},
                            params_.color, {(pixels.x + 7) / 8, (pixels.y + 7) / 8, 1});
}

}  // namespace voxray
