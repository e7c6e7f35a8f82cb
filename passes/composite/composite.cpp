#include "passes/composite/composite.h"

#include "passes/common/view/frame_image.h"

namespace voxray {

void Composite::declare(PassBuilder& builder) {
    gbuffer_ = builder.read<GBuffer>("gbuffer", "what the camera sees");
    direct_ = builder.readOptional<FrameImage>("direct", "radiance reflected of direct light");
    indirect_ = builder.readOptional<FrameImage>("indirect", "radiance reflected of indirect light");
    final_ = builder.write<FrameImage>("final", "radiance towards the camera");
}

void Composite::plan(PassPlan& plan) {
    plan.image(plan.get(final_).image, "final", frameImageDesc(plan.frame));
    plan.image(black_, "black", ImageDesc{});
}

void Composite::prepare(PassSetup& setup) {
    program_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/composite/composite.comp"),
                                  SpecializationConstants{{"kHasAmbient", params_.ambient > 0}});
    setup.stream.clear(black_, {});
}

void Composite::record(PassContext& context) {
    const Image& direct = context.has(direct_) ? context.get(direct_).image : black_;
    const Image& indirect = context.has(indirect_) ? context.get(indirect_).image : black_;
    const GBuffer& gbuffer = context.get(gbuffer_);
    context.stream.dispatch(program_, glm::uvec2(context.frame.width, context.frame.height),
                            {{"emission", gbuffer.emission},
                             {"albedo", gbuffer.albedo},
                             {"direct", direct},
                             {"indirect", indirect},
                             {"result", context.get(final_).image},
                             {"samples", gbuffer.samples},
                             {"ambient", params_.ambient}});
}

}  // namespace voxray
