#pragma once

#include <memory>

#include "graph/pass.h"
#include "trace/embree_scene.h"

namespace voxray {

/// The reference path tracer (path_tracer.h) as a pass: many samples make it the judge of all others, few
/// make it the baseline on the chart. It shares no shader and no stream with the methods that it judges.
class PathTracePass final : public Pass {
 public:
    static constexpr const char* kName = "path_trace";
    static constexpr const char* kHelp =
        "Path tracer on the CPU (Embree): next-event estimation and multiple importance sampling, "
        "Owen-scrambled Sobol "
        "points. Unbiased for the bounces that it is given; noisy by: spp. Writes total and indirect light "
        "and the variance "
        "of each pixel's mean.";
    struct Params {
        uint32_t spp = 64;
        uint32_t bounces = 8;
        static constexpr auto schema() {
            return std::tuple{
                field("spp", &Params::spp, "Samples a pixel.", 1u, 1u << 20),
                field(
                    "bounces", &Params::bounces,
                    "Scattering events after direct light at the first hit; 0 is emission and direct light.",
                    0u, 1024u)};
        }
    };

    explicit PathTracePass(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<FrameImage> final_, indirect_, variance_, indirectVariance_;
    std::unique_ptr<EmbreeScene> embree_;
};

}  // namespace voxray
