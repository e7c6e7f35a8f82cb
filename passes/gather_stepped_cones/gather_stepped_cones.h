#pragma once

#include "passes/common/radiance/radiance_voxels.h"
#include "passes/common/view/frame_image.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Indirect light by cones in free steps, as published: a baseline for gather_cones. Source: Arnebäck 2017,
/// sections 3.1.5 and 3.2.5, after Crassin et al. 2011.
class GatherSteppedCones final : public Pass {
 public:
    static constexpr const char* kName = "gather_stepped_cones";
    static constexpr const char* kHelp =
        "Indirect light as published, for comparison with gather_cones: six cones of 60 degrees in fixed "
        "directions about the normal, weighed by their cosine; each is sampled at points along its axis and "
        "composited front to back. Biased by: voxel size; six directions; closed walls that a step passes, "
        "or "
        "meets twice. No noise. Source: Arnebäck 2017, sections 3.1.5 and 3.2.5.";
    struct Params {
        float step = 0.5f;
        float start = 1.0f;
        static constexpr auto schema() {
            return std::tuple{field("step", &Params::step,
                                    "From a sample to the next, in widths of the cone there; each counts for "
                                    "so much of its width.",
                                    0.125f, 1.0f),
                              field("start", &Params::start,
                                    "From the surface to a cone's first sample, in voxels. Near ones see the "
                                    "surface itself, far ones pass what is near. As published it is unknown.",
                                    0.5f, 16.0f)};
        }
    };

    explicit GatherSteppedCones(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const RadianceVoxels> radiance_;
    Port<FrameImage> indirect_;
    Program trace_;
    Sampler sampler_;
};

}  // namespace voxray
