#include "graph/registry.h"
#include "passes/common/view/gbuffer.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

class GatherSteppedCones final : public Pass {
 public:
    static constexpr const char* kName = "gather_stepped_cones";
    static constexpr const char* kHelp =
        "Gathers indirect light by six cones of 60 degrees, as published, and by a specular one. "
        "For comparison with gather_cones. "
        "The cones have fixed directions about the normal and are weighted by their cosine. "
        "Each is sampled at points along its axis and composited front to back. "
        "The specular cone has the direction of reflection. "
        "Biased by: voxel size; six directions; thin walls that a step skips or samples twice. No noise. "
        "Source: Arnebäck 2017, sections 3.1.5 and 3.2.5.";
    struct Params {
        float step = 0.5f;
        float start = 1.0f;
        bool opacityCorrection = true;
        bool specular = false;
        static constexpr auto schema() {
            return std::tuple{
                field("step", &Params::step, "Distance between samples, in widths of the cone.", 0.125f, 1.0f),
                field("start", &Params::start,
                      "Voxels, of the size that counts there, from the surface to a cone's first sample "
                      "(not given in the thesis). "
                      "If small, the surface itself is sampled; if large, close surfaces are skipped.",
                      0.5f, 16.0f),
                field("opacity_correction", &Params::opacityCorrection,
                      "Whether opacity is per length: a sample's opacity a is 1 - (1 - a)^step, "
                      "and that of two levels is interpolated for equal lengths. "
                      "Off: as in the thesis's equation 3, "
                      "where each sample counts in full, so that shorter steps find more opacity."),
                field("specular", &Params::specular,
                      "Whether surfaces with a specular lobe have a cone in the direction of reflection, "
                      "times their reflectance there. It holds half of the lobe's normals, mirrored "
                      "(the thesis only says that rough surfaces have wide cones); its light is added to the diffuse. "
                      "Off: surfaces reflect by their diffuse albedo only.")};
        }
    };
    explicit GatherSteppedCones(const Params& params) : params_(params) {}

    void plan(PassPlan& plan) override {
        plan[indirect_].lightBounces = plan[radiance_].lightBounces;
        plan.frameImage(indirect_);
        traceCones_.define(plan[radiance_].defines());
        traceCones_.specialize(
            {{"kCorrectsOpacity", params_.opacityCorrection}, {"kTracesSpecular", params_.specular}});
    }
    void record(PassContext& context) override {
        context.dispatch(traceCones_, context.frame.pixels(),
                         {context[gbuffer_],
                          context[radiance_],
                          {"result", context[indirect_].image},
                          {"camera", context.frame.camera.position},
                          {"step", params_.step},
                          {"start", params_.start}});
    }

 private:
    const Params params_;
    In<GBuffer> gbuffer_{*this, "gbuffer", "what the camera sees"};
    In<RadianceVoxels> radiance_{*this, "radiance", "light that leaves surfaces, at all scales"};
    Out<FrameImage> indirect_{*this, "indirect", "radiance reflected of indirect light"};
    Kernel traceCones_{*this, "trace_cones.comp"};
};
VOXRAY_REGISTER_PASS(GatherSteppedCones);

}  // namespace voxray
