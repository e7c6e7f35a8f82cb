#pragma once

#include <string>
#include <vector>

#include "passes/common/voxels.h"

namespace voxray {

/// Light tracing: every light sends rays that carry its power, each hit leaves what it carries in the voxel
/// that it hits, then goes on diffusely. The sum over rays is the flux that a voxel's surfaces catch; divided
/// by their area it is their mean irradiance, with no factor to calibrate. Flux is summed in 64-bit fixed
/// point, so that the result is exact to float rounding and independent of order. Source: Magalhães 2020,
/// section 3.3 (rays from the light, atomic average); flux over area instead of a mean of deposits is ours:
/// it stays right where several lights or a light and a shadow share a voxel.
class InjectLightRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_light_rays";
    static constexpr const char* kHelp =
        "Traces rays from every light and leaves the power that they carry in the voxels that they hit; then "
        "they bounce "
        "diffusely. Biased by: voxel size. Noisy by: rays_per_light. Leaves unlit: nothing that light "
        "reaches, given rays "
        "enough. All surfaces bounce as Lambert surfaces of their base colour. Source: Magalhães 2020, "
        "section 3.3.";
    struct Params {
        uint32_t raysPerLight = 262144;
        uint32_t bounces = 8;
        static constexpr auto schema() {
            return std::tuple{
                field("rays_per_light", &Params::raysPerLight,
                      "Rays that each punctual light sends; all emissive surfaces together count as one "
                      "light, the environment as another.",
                      1u, 1u << 26),
                field("bounces", &Params::bounces,
                      "Diffuse bounces after a ray's first hit; Russian roulette by albedo ends paths early.",
                      0u, 64u)};
        }
    };

    explicit InjectLightRays(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Build; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// What sends rays: one punctual light, all emissive triangles, or the environment.
    struct Source {
        uint32_t kind;   ///< As in emit.comp.
        uint32_t light;  ///< Index of a punctual light.
        float power;     ///< W, an upper bound over the colour channels.
    };
    std::vector<Source> sources(const Frame& frame, const GpuScene& scene) const;

    Params params_;
    Port<SurfaceVoxels> voxels_;
    Port<VoxelIrradiance> irradiance_;
    Program emit_, expose_, deposit_, resolve_, exposedArea_;
    Buffer rays_, hits_, carried_, exposureRays_, hidden_;
};

}  // namespace voxray
