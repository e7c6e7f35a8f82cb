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

/// How a ray of light goes on from a surface.
enum class Secondary { None, Mirror, Diffuse, Material };
template <>
struct EnumNames<Secondary> {
    static constexpr std::array names{
        std::pair{Secondary::None, "none"}, std::pair{Secondary::Mirror, "mirror"},
        std::pair{Secondary::Diffuse, "diffuse"}, std::pair{Secondary::Material, "material"}};
};

/// The parameters that all passes share whose rays start at the lights.
struct LightPathParams : WriteParams {
    Secondary secondary = Secondary::Diffuse;
    uint32_t bounces = 8;
    bool caustics = true;
    static constexpr auto schema() {
        return std::tuple_cat(
            WriteParams::schema(),
            std::tuple{
                field("secondary", &LightPathParams::secondary,
                      "How rays continue after a hit: none gives direct light only; "
                      "mirror is that of Magalhães 2020, about the normal and times the albedo; "
                      "diffuse is a Lambert surface's, with Russian roulette by albedo; "
                      "material goes by the surface's own lobes, "
                      "so that mirrors and glossy surfaces throw light at others."),
                field("bounces", &LightPathParams::bounces, "Bounces after a ray's first hit.", 0u, 64u)
                    .onlyWith(noneOf(&LightPathParams::secondary, {Secondary::None})),
                field("caustics", &LightPathParams::caustics,
                      "Whether perfect mirrors throw what comes straight from a point, "
                      "spot or directional light at other surfaces. "
                      "The reference does not: no path from the eye finds it.")
                    .onlyWith(oneOf(&LightPathParams::secondary, {Secondary::Material}))});
    }
    uint32_t lastBounce() const { return secondary == Secondary::None ? 0 : bounces; }
};

/// Follows rays from lights: each hit leaves light in its voxel, then the ray bounces. Whoever emits writes
/// rays() and paths(), and hits() where it knows the first hit already.
///
/// `write: average` sums each ray's flux over the voxel's unoccluded area. The other ways merge irradiances,
/// as the thesis: the beam's power over its cross-section at the hit, times the cosine. A diffusely scattered
/// ray has no cross-section, so they take punctual lights and mirror bounces only. Source: Magalhães 2020,
/// sections 3.3.1 and 4.3.2.5.
class LightPaths {
 public:
    LightPaths(ProgramOwner& owner, const LightPathParams& params);

    /// Describes the memory of rays and estimates the result's. @param batch rays followed at once, at most.
    /// @throws Error naming `pass` for what these parameters, lights or the device can't do.
    void plan(PassPlan& plan, const std::string& pass, uint32_t batch, const SurfaceVoxels& voxels,
              const std::vector<LightSource>& sources);

    void begin(PassContext& context, const SurfaceVoxels& voxels, const std::vector<LightSource>& sources);
    /// A batch of rays of one source: rays [first, first + count) of its stream.
    struct Batch {
        uint32_t seed;
        uint32_t first;
        uint32_t count;
        bool hitsKnown = false;
    };
    void follow(PassContext& context, const SurfaceVoxels& voxels, const Batch& batch);
    /// Allocates and fills the result, and frees the sums. @throws Error where no light fell on any voxel.
    void finish(PassContext& context, const SurfaceVoxels& voxels, VoxelIrradiance& irradiance);

    const Buffer& rays() const { return rays_; }    ///< Ray each.
    const Buffer& hits() const { return hits_; }    ///< Hit each.
    const Buffer& paths() const { return paths_; }  ///< gpu::LightPath each.

 private:
    /// How much is summed apart: direct light, and indirect light where there is any.
    size_t targets() const { return params_.lastBounce() > 0 ? 2 : 1; }

    const LightPathParams params_;
    const bool sumsFlux_;  ///< Else irradiance samples are merged.
    Kernel visibility_, follow_, unoccludedArea_;
    Buffer rays_, hits_, paths_, visibilityRays_, hidden_;
    PaneTransmittance paneTransmittance_;
    std::array<std::optional<FluxAccumulator>, 2> fluxes_;        ///< Of each target, where flux is summed.
    std::array<std::optional<VoxelAccumulator>, 2> irradiances_;  ///< Of each target, else.
};

}  // namespace voxray
