#pragma once

#include "passes/common/light_paths/light_emission.h"
#include "passes/common/light_paths/light_paths.h"

namespace voxray {

/// Light tracing: every light sends rays that carry its power, each hit leaves what it carries in the voxel
/// that it hits, then goes on. The sum over rays is the flux that a voxel's surfaces catch; divided by their
/// area it is their mean irradiance, with no factor to calibrate. Source: Magalhães 2020, section 3.3 (rays
/// from the light); flux over area instead of a mean of deposits is ours: it stays right where several lights
/// or a light and a shadow share a voxel.
class InjectLightRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_light_rays";
    static constexpr const char* kHelp =
        "Traces rays from every light and leaves the power that they carry in the voxels that they hit; then "
        "they bounce. Biased by: voxel size; write other than average; secondary: mirror, which takes every "
        "surface for a coloured mirror. Noisy by: rays_per_light. Leaves unlit: nothing that light reaches, "
        "given rays enough. With diffuse bounces all surfaces are Lambert surfaces of their base colour. "
        "Source: Magalhães 2020, section 3.3.";
    struct Params : LightPathParams {
        uint32_t raysPerLight = 1048576;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{field("rays_per_light", &Params::raysPerLight,
                                 "Rays that each punctual light sends; all emissive surfaces together count "
                                 "as one light, the environment as another.",
                                 1u, 1u << 26)
                               .lessNoise()},
                LightPathParams::schema());
        }
    };

    explicit InjectLightRays(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<VoxelIrradiance> irradiance_;
    LightEmission emission_;
    LightPaths paths_;
};

}  // namespace voxray
