#pragma once

#include "passes/common/light_paths/light_paths.h"
#include "passes/common/lights/rsm.h"

namespace voxray {

/// Reflective shadow maps: a view of the scene from every light is rasterised, and what each texel sees gets
/// the light through the texel. A texel is thus a light ray whose first hit the rasteriser found; bounces are
/// traced. Source: Dachsbacher and Stamminger 2005; Crassin et al. 2011, section 6 (injection into voxels).
class InjectRsm final : public Pass {
 public:
    static constexpr const char* kName = "inject_rsm";
    static constexpr const char* kHelp =
        "Rasterises the scene from every light and leaves the light through each texel in the voxel that the "
        "texel sees; then rays bounce. Point lights take a cube of six views, spots one (wider than 90° "
        "across: the cube), directional lights one over the scene's bounding sphere. No emissive surfaces "
        "and no environment: they have no single viewpoint. Biased by: voxel size; rsm_resolution (texels "
        "larger than voxels leave gaps). Noisy by: bounces alone, of rays from each texel (rsm_resolution). "
        "Leaves unlit: what lies nearer to a light "
        "than 0.0001 of the scene's extent. Source: Dachsbacher and Stamminger 2005.";
    struct Params : LightPathParams {
        uint32_t rsmResolution = 768;
        static constexpr auto schema() {
            return std::tuple_cat(std::tuple{field("rsm_resolution", &Params::rsmResolution,
                                                   "Texels along an edge of each view.", 1u, 4096u)
                                                 .lessNoise()},
                                  LightPathParams::schema());
        }
    };

    explicit InjectRsm(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    uint32_t texels() const { return params_.rsmResolution * params_.rsmResolution; }

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<VoxelIrradiance> irradiance_;
    RsmImage map_;
    Program makeRays_;
    LightPaths paths_;
};

}  // namespace voxray
