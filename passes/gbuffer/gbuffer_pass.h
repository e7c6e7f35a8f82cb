#pragma once

#include "passes/common/gbuffer.h"

namespace voxray {

/// Rasterises what the camera sees: one sample at each pixel's centre.
class GBufferPass final : public Pass {
 public:
    static constexpr const char* kName = "gbuffer";
    static constexpr const char* kHelp =
        "Rasterises position, normals, albedo and emission of what the camera sees, one sample at each "
        "pixel's centre. "
        "Biased at edges, where the reference averages over the pixel.";
    struct Params {
        static constexpr auto schema() { return std::tuple{}; }
    };

    explicit GBufferPass(const Params&) {}
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Port<GBuffer> gbuffer_;
    Program background_, surfaces_;
};

}  // namespace voxray
