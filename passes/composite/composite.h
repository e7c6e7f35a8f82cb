#pragma once

#include "passes/common/view/gbuffer.h"

namespace voxray {

/// final = emission + direct + indirect, and ambient light.
class Composite final : public Pass {
 public:
    static constexpr const char* kName = "composite";
    static constexpr const char* kHelp =
        "Adds up what the camera sees: emitted light (or the environment), direct and indirect light. A part "
        "that no pass "
        "writes counts as black.";
    struct Params {
        float ambient = 0.0f;
        static constexpr auto schema() {
            return std::tuple{
                field("ambient", &Params::ambient,
                      "Radiance, W/(m² sr), that a white surface sends out besides, others by their albedo, "
                      "whatever light arrives there. As published in Magalhães 2020 (section 4.4): 0.2, to "
                      "stand for light that is missing.",
                      0.0f, 1e9f)};
        }
    };

    explicit Composite(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const FrameImage> direct_, indirect_;
    Port<FrameImage> final_;
    Program program_;
    Image black_;
};

}  // namespace voxray
