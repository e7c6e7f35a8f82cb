#pragma once

#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// The rays of a hybrid final gather: geometry from rays, light at their hits from voxels. Tracing stands
/// apart from shading, so that an injection pass can light just what the rays hit (inject_gather_hits).
/// Source: Magalhães 2020, section 6.1 (rays for detail below a voxel); sampling: Ahmed and Wonka 2020.
class TraceGatherRays final : public Pass {
 public:
    static constexpr const char* kName = "trace_gather_rays";
    static constexpr const char* kHelp =
        "Traces rays from what the camera sees, distributed by cosine, for gather_rays to shade. Exact "
        "geometry; noisy by: rays_per_block. Where a block has fewer rays than texels, filter_irradiance "
        "fills the "
        "texels "
        "without any.";
    struct Params {
        uint32_t raysPerBlock = 16;
        uint32_t block = 1;
        static constexpr auto schema() {
            return std::tuple{
                field("rays_per_block", &Params::raysPerBlock, "Rays of each block.", 1u, 65536u).lessNoise(),
                field("block", &Params::block, "Texels of the G-buffer along a block's edge.",
                      powersOfTwo(1, 8))};
        }
    };

    explicit TraceGatherRays(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<GatherHits> hits_;
    Program emit_;
    Sampler sampler_;
    Buffer rays_;
};

}  // namespace voxray
