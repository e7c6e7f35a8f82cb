#pragma once

#include "passes/common/surfels/surfel_injection.h"
#include "passes/common/surfels/surfel_light.h"
#include "passes/common/surfels/surfel_links.h"
#include "passes/common/surfels/surfels.h"
#include "passes/common/surfels/surfels_by_voxel.h"

namespace voxray {

/// Light between surfels along links that were found beforehand: shadow rays to the lights, and no ray for
/// any bounce. Source: Goral et al. 1984; Lehtinen et al. 2008; docs/radiosity.md.
class InjectRadiosity final : public Pass {
 public:
    static constexpr const char* kName = "inject_radiosity";
    static constexpr const char* kHelp =
        "Direct light of the voxels' surfels by shadow rays, indirect light along the links of link_surfels: "
        "a "
        "sum over links for each bounce, no rays. For light that changes where surfaces don't. Biased by: "
        "voxel "
        "size, surfels' distance; textures' normals are left out. Noisy by: points_per_voxel, "
        "rays_per_surfel. "
        "Leaves unlit: nothing. Source: Goral et al. 1984; Lehtinen et al. 2008.";
    struct Params : WriteParams {
        uint32_t bounces = 8;
        uint32_t lightSamples = 4;
        static constexpr auto schema() {
            return std::tuple_cat(
                WriteParams::schema(),
                std::tuple{
                    field("bounces", &Params::bounces, "Bounces of light.", 0u, 64u),
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u,
                          256u)});
        }
    };

    explicit InjectRadiosity(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Of a chunk of surfels, W/m², 4 floats each.
    struct ChunkLight {
        Buffer direct, indirect;
    };
    /// Direct irradiance of all chunks, and what it leaves of radiosity.
    std::vector<ChunkLight> measure(PassContext& context);
    /// Bounce 1, 2 ...: adds to the indirect irradiance of all chunks.
    void bounce(PassContext& context, uint32_t number, const std::vector<ChunkLight>& light);

    /// Leaves the indirect irradiance of all chunks in the surfels' slots.
    void keep(PassContext& context, const std::vector<ChunkLight>& light);

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const Surfels> surfels_;
    Port<const SurfelLinks> links_;
    Port<const SurfelsByVoxel> byVoxel_;
    Port<VoxelIrradiance> irradiance_;
    Port<SurfelIrradiance> surfelIrradiance_;
    std::vector<LightSource> sources_;
    SurfelLight light_;
    SurfelInjection injection_;
    Program reflect_, bounce_, keep_;
    LargeBuffer radiosity_[2];  ///< Scratch: of all surfels, packed; before and after a bounce.
};

}  // namespace voxray
