#pragma once

#include "passes/common/view/gbuffer.h"

namespace voxray {

/// final = emission + direct + indirect.
class Composite final : public Pass {
 public:
    static constexpr const char* kName = "composite";
    static constexpr const char* kHelp =
        "Adds up what the camera sees: emitted light (or the environment), direct and indirect light. A part "
        "that no pass "
        "writes counts as black.";
    struct Params {
        static constexpr auto schema() { return std::tuple{}; }
    };

    explicit Composite(const Params&) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Port<const GBuffer> gbuffer_;
    Port<const FrameImage> direct_, indirect_;
    Port<FrameImage> final_;
    Program program_;
    Sampler sampler_;
    Image black_;
};

}  // namespace voxray
