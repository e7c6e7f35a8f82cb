#pragma once

#include "passes/common/radiance/cone_sets.h"
#include "passes/common/radiance/radiance_voxels.h"
#include "passes/common/view/gbuffer.h"
#include "passes/gather_cones/near_field.h"
#include "passes/gather_cones/specular_cones.h"

namespace voxray {

/// Indirect light by cone tracing. Source: Crassin et al. 2011; Arnebäck 2017, sections 3.1.5 and 3.2.5.
class GatherCones final : public Pass {
 public:
    static constexpr const char* kName = "gather_cones";
    static constexpr const char* kHelp =
        "Indirect light: a few cones from each pixel through prefiltered voxels (filter_voxels). "
        "Biased by: voxel size; the number of cones; a mean over some 25 pixels of the same surface, which "
        "evens "
        "out the fixed pattern of directions; the shape of specular lobes. Noisy by near_field_voxels alone. "
        "Time grows with the cones of each texel, so on a CPU begin with `stride: 4`, a quarter of them, and "
        "`specular: 0` where nothing is glossy. "
        "Source: Crassin et al. 2011; Arnebäck 2017, section 3.1.5.";
    struct Params {
        uint32_t cones = 16;
        uint32_t stride = 1;
        uint32_t specular = 7;
        float nearFieldVoxels = 0;
        static constexpr auto schema() {
            return std::tuple{
                field("cones", &Params::cones,
                      "Cones that divide up the hemisphere; the set of 6 is that of Arnebäck 2017.",
                      coneSetSizes()),
                field("stride", &Params::stride,
                      "Traces every n-th texel of the g-buffer; the others take the mean of the traced ones "
                      "around them that lie on the same surface.",
                      1u, 64u),
                field("specular", &Params::specular,
                      "Cones that divide up the specular lobe of each texel of the g-buffer; a mirror takes "
                      "one. 0: surfaces reflect by their diffuse albedo alone.",
                      {0, 1, 7, 19}),
                field("near_field_voxels", &Params::nearFieldVoxels,
                      "Diffuse cones begin with a ray, so many voxels of the finest level long. Where it "
                      "hits, light is measured by shadow rays and a ray goes on as a path does, up to twice; "
                      "where not, the cone begins behind it. 0: no rays.",
                      0.0f, 64.0f)};
        }
    };

    explicit GatherCones(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Whether specular light goes into `indirect`: else a later pass joins `lobes`. Known once all have
    /// planned.
    bool reflectsLobes(const PortAccess& ports) const {
        return params_.specular > 0 && !ports.get(lobes_).isJoined;
    }
    bool hasNearField() const { return params_.nearFieldVoxels > 0; }
    /// Cones alone.
    void trace(PassContext& context, const GBuffer& gbuffer, const RadianceVoxels& radiance) const;

    Params params_;
    Port<const GBuffer> gbuffer_;
    Port<const RadianceVoxels> radiance_;
    Port<FrameImage> indirect_;
    Port<SpecularLobes> lobes_;  ///< With `specular`.
    Program trace_, resolve_;
    Sampler sampler_;
    Buffer cones_;
    Image irradiance_;
    SpecularCones specular_;
    NearField near_;
};

}  // namespace voxray
