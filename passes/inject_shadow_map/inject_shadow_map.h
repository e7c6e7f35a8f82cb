#pragma once

#include "passes/common/lights/shadow_map.h"
#include "passes/common/surfels/surfel_injection.h"
#include "passes/common/surfels/surfels.h"

namespace voxray {

/// Direct light of the voxels' surfaces by shadow maps: a depth view of the scene from every light is
/// rasterised, and points on the surfaces are tested against it, with percentage-closer filtering over 2x2
/// texels. Bounces by paths, as inject_voxel_rays. Source: Arnebäck 2017 tests voxels against a shadow map
/// as they are voxelized; filtering: Reeves et al. 1987.
class InjectShadowMap final : public Pass {
 public:
    static constexpr const char* kName = "inject_shadow_map";
    static constexpr const char* kHelp =
        "Tests points on the voxels' surfaces (place_surfels) against a shadow map of every light; bounces "
        "by paths with shadow rays. Point lights take a cube of six maps, spots one (wider than "
        "90° across: the cube), directional lights one over the scene's bounding sphere. No emissive "
        "surfaces and no environment: they have no single viewpoint. Biased by: voxel size; "
        "shadow_resolution "
        "(shadow edges and gaps below a texel). Noisy by: points_per_voxel, paths_per_point. Leaves unlit: "
        "nothing; what lies "
        "nearer to a light than 0.0001 of the scene's extent casts no shadow.";
    struct Params : SurfelParams {
        uint32_t shadowResolution = 1024;
        static constexpr auto schema() {
            return std::tuple_cat(std::tuple{field("shadow_resolution", &Params::shadowResolution,
                                                   "Texels along an edge of each shadow map.", 2u, 8192u)},
                                  SurfelParams::schema());
        }
    };

    explicit InjectShadowMap(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const Surfels> surfels_;
    Port<VoxelIrradiance> irradiance_;
    std::vector<LightSource> sources_;
    Program lightSurfels_;
    ShadowMap shadowMap_;
    SurfelInjection injection_;
};

}  // namespace voxray
