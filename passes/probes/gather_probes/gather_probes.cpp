#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/probes/probes.h"

namespace voxray {

/// Light of each pixel by a lookup between probes: albedo / pi times the irradiance there. Source: Majercik et
/// al. 2019, section 5; Majercik et al. 2021, sections 4.1 (bias) and 7.4 (cascades).
class GatherProbes final : public Pass {
 public:
    static constexpr const char* kName = "gather_probes";
    static constexpr const char* kHelp =
        "Looks indirect light up between irradiance probes at each pixel. "
        "Interpolates the eight probes around it, weighted by whether they see it and by the normal; "
        "update_probes has the parameters of the lookup, as its rays use it, too. No ray is traced. "
        "Biased by: the spacing of probes. Noisy by: rays_per_probe and updates of update_probes. "
        "Lambert surfaces only. Source: Majercik et al. 2019 and 2021. Reports where there is no probe: black.";
    void plan(PassPlan& plan) override {
        plan[indirect_].lightBounces = plan[probes_].lightBounces;
        plan.frameImage(indirect_);
        plan.buffer(counts_, "counts of lookups", 2 * sizeof(uint32_t));
    }
    void record(PassContext& context) override {
        context.stream.fill(counts_, 0);
        context.dispatch(gather_, context.frame.pixels(),
                         {context[gbuffer_],
                          context[probes_],
                          {"counts", counts_},
                          {"camera", context.frame.camera.position},
                          {"result", context[indirect_].image}});
        const std::vector<uint32_t> counts = context.stream.readAs<uint32_t>(counts_, 2);
        context.report("lookups without a probe, %", counts[0] > 0 ? 100.0 * counts[1] / counts[0] : 0);
    }

 private:
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<Probes> probes_{*this, "probes", "irradiance in a grid of points"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light"};
    Kernel gather_{*this, "gather_probes.comp"};
    Buffer counts_;
};
VOXRAY_REGISTER_PASS(GatherProbes);

}  // namespace voxray
