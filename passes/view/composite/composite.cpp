#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

class Composite final : public Pass {
 public:
    static constexpr const char* kName = "composite";
    static constexpr const char* kHelp =
        "Adds emitted light (or the environment), direct, indirect and ambient light. Missing inputs are black. "
        "Source of ambient light: Magalhães 2020, section 4.4, where it is 0.2.";
    struct Params {
        float ambient = 0.0f;
        static constexpr auto schema() {
            return std::tuple{field("ambient", &Params::ambient, "Ambient radiance, W/(m² sr).", 0.0f, 1e9f)};
        }
    };
    explicit Composite(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override { plan.frameImage(final_); }
    void record(PassContext& context) override {
        context.dispatch(kernel_, context.frame.pixels(),
                         {context[gbuffer_],
                          {"direct", context.orBlack(direct_)},
                          {"indirect", context.orBlack(indirect_)},
                          {"result", context[final_].image},
                          {"ambient", params_.ambient}});
    }

 private:
    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    InOptional<FrameImage> direct_{*this, "direct", "radiance reflected of direct light"};
    InOptional<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light"};
    Out<FrameImage> final_{*this, "final", "radiance towards the camera"};
    Kernel kernel_{*this, "composite.comp"};
};
VOXRAY_REGISTER_PASS(Composite);

}  // namespace voxray
