#include "graph/registry.h"

namespace voxray {

/// Multiplies an image by a colour. The template of a pass: copy this folder to passes/<family>/<name>/.
class Tint final : public Pass {
 public:
    static constexpr const char* kName = "tint";
    static constexpr const char* kHelp =
        "Multiplies an image by a colour.\n"
        "Exact: no bias, no noise. Source: the template of docs/writing-a-pass.md.";
    struct Params {
        glm::vec3 color{1.0f};
        static constexpr auto schema() {
            return std::tuple{
                field("color", &Params::color, "Factor of each channel.", glm::vec3(0.0f), glm::vec3(1000.0f))};
        }
    };
    explicit Tint(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override { plan.frameImage(final_); }
    void record(PassContext& context) override {
        context.dispatch(
            kernel_, context.frame.pixels(),
            {{"source", context[source_].image}, {"target", context[final_].image}, {"color", params_.color}});
    }

 private:
    const Params params_;
    In<FrameImage> source_{*this, "source", "Image to tint."};
    Out<FrameImage> final_{*this, "final", "The tinted image."};
    Kernel kernel_{*this, "tint.comp"};
};
VOXRAY_REGISTER_PASS(Tint);

}  // namespace voxray
