#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/common/voxels/flux_accumulator.h"
#include "passes/common/voxels/voxel_accumulator.h"

namespace voxray {

/// How rays scatter at surfaces.
enum class Secondary { None, Mirror, Diffuse, Material };
template <>
struct EnumNames<Secondary> {
    static constexpr std::array names{std::pair{Secondary::None, "none"}, std::pair{Secondary::Mirror, "mirror"},
                                      std::pair{Secondary::Diffuse, "diffuse"},
                                      std::pair{Secondary::Material, "material"}};
};

/// Parameters of passes that trace paths from the lights.
struct LightPathParams : WriteParams {
    Secondary secondary = Secondary::Diffuse;
    uint32_t bounces = 8;
    bool caustics = true;
    static constexpr auto schema() {
        return std::tuple_cat(
            WriteParams::schema(),
            std::tuple{
                field("secondary", &LightPathParams::secondary,
                      "How rays continue after a hit. none: they don't, which gives direct light only. mirror: "
                      "by mirror reflection times the albedo, as in Magalhães 2020. diffuse: cosine-distributed, "
                      "with Russian roulette by albedo. material: by the surface's specular and diffuse lobes, "
                      "so that mirrors and glossy surfaces reflect light onto others."),
                field("bounces", &LightPathParams::bounces, "Bounces after a ray's first hit.", 0u, 64u)
                    .onlyWith(noneOf(&LightPathParams::secondary, {Secondary::None})),
                field("caustics", &LightPathParams::caustics,
                      "Whether perfect mirrors reflect rays that come straight from a point, "
                      "spot or directional light. The reference lacks that light: no path from the camera finds it.")
                    .onlyWith(oneOf(&LightPathParams::secondary, {Secondary::Material}))});
    }
    uint32_t lastBounce() const { return secondary == Secondary::None ? 0 : bounces; }
};

/// Traces paths from the lights: each hit deposits light in its voxel, then the ray scatters. The caller
/// writes rays() and paths(), and hits() where it knows the first hits.
///
/// `write: average` sums the flux of rays over the voxel's unoccluded area. The other modes merge
/// irradiances, as the thesis does: the beam's power over its cross-section at the hit, times the cosine.
/// Diffusely scattered rays have no cross-section, so these modes take punctual lights and mirror bounces
/// only. Source: Magalhães 2020, sections 3.3.1 and 4.3.2.5.
class LightPaths {
 public:
    LightPaths(ProgramOwner& owner, const LightPathParams& params);

    /// Describes the memory of rays and estimates the result's. @param batch maximum number of rays at once.
    /// @throws Error naming `pass` for parameters, lights or devices that don't fit.
    void plan(PassPlan& plan, const std::string& pass, uint32_t batch, const VoxelLevels& voxels,
              const std::vector<LightSource>& sources);

    void begin(PassContext& context, const VoxelLevels& voxels, const std::vector<LightSource>& sources);
    /// Rays [first, first + count) of one source.
    struct Batch {
        uint32_t seed;
        uint32_t first;
        uint32_t count;
        bool hasFirstHits = false;  ///< Whether hits() are written.
    };
    void trace(PassContext& context, const VoxelLevels& voxels, const Batch& batch);
    /// Allocates and fills the result, and frees the accumulators. @throws Error where no light fell on any
    /// voxel.
    void finish(PassContext& context, const VoxelLevels& voxels, VoxelIrradiance& irradiance);

    const Buffer& rays() const { return rays_; }    ///< Ray each.
    const Buffer& hits() const { return hits_; }    ///< Hit each.
    const Buffer& paths() const { return paths_; }  ///< gpu::LightPath each.

 private:
    /// One for direct light, and one for indirect light where there is any.
    size_t accumulatorCount() const { return params_.lastBounce() > 0 ? 2 : 1; }

    const LightPathParams params_;
    const bool sumsFlux_;  ///< Else irradiances are merged.
    Kernel generateOcclusionRays_, deposit_, unoccludedArea_;
    Buffer rays_, hits_, paths_, occlusionRays_, occluded_;
    PaneTransmittance paneTransmittance_;
    std::array<std::optional<FluxAccumulator>, 2> fluxes_;        ///< Where flux is summed.
    std::array<std::optional<VoxelAccumulator>, 2> irradiances_;  ///< Else.
};

}  // namespace voxray
