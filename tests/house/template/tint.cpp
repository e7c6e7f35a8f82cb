#include "tests/house/template/tint.h"

namespace voxray {

void Tint::declare(PassBuilder& builder) {
    source_ = builder.read<FrameImage>("source", "Image to tint.");
    final_ = builder.write<FrameImage>("final", "The tinted image.");
}

void Tint::plan(PassPlan& plan) {
    desc_.extent = {plan.frame.width, plan.frame.height, 1};
    plan.reserve("tinted image", imageBytes(desc_));
}

void Tint::prepare(PassSetup& setup) {
    setup.get(final_).image = Image(setup.device, "tint.final", desc_);
    program_ = makeComputeProgram(setup.device, setup.compiler.compile("tests/house/template/tint.comp"));
}

void Tint::record(PassContext& context) {
    context.stream.dispatch(program_,
                            {{"source", context.get(source_).image}, {"target", context.get(final_).image}},
                            params_.color, {(desc_.extent.x + 7) / 8, (desc_.extent.y + 7) / 8, 1});
}

}  // namespace voxray
