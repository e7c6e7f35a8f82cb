#pragma once

#include <optional>

#include "passes/common/surfels/surfel_injection.h"
#include "passes/common/surfels/surfels.h"
#include "passes/common/view/gather_hits.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Lights only the faces of voxels that the frame's gather rays will read, each by paths from points on
/// it: shadow rays to the lights, a diffuse ray on, and so on. Source: Magalhães 2020, section 6.1 (light
/// only what the view needs).
class InjectGatherHits final : public Pass {
 public:
    static constexpr const char* kName = "inject_gather_hits";
    static constexpr const char* kHelp =
        "Lights the voxel faces that the rays of trace_gather_rays hit, in each frame, by paths from points "
        "on "
        "them (place_surfels). Biased by: voxel size. Noisy by: points_per_voxel, "
        "paths_per_point. Leaves unlit: all that "
        "trace_gather_rays (which must come before) does not hit.";
    struct Params : SurfelParams {
        uint32_t lightSamples = 1;
        /// In each frame, for gather rays, which average over many points: few paths do.
        Params() { pathsPerPoint = 1; }
        static constexpr auto schema() {
            return std::tuple_cat(
                SurfelParams::schema(),
                std::tuple{
                    field("light_samples", &Params::lightSamples,
                          "Shadow rays from each point to the emissive surfaces, and to the environment.", 1u,
                          256u)});
        }
    };

    explicit InjectGatherHits(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    void markFaces(PassContext& context);
    void lightFaces(PassContext& context, const PathScene& scene);

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const Surfels> surfels_;
    Port<const GBuffer> gbuffer_;
    Port<const GatherHits> hits_;
    Port<VoxelIrradiance> irradiance_;
    std::vector<LightSource> sources_;
    SurfelInjection injection_;
    Program measure_, mark_, select_;
    Buffer selected_, count_;  ///< Of a chunk's surfels, those to light.
    Buffer faces_;             ///< A bit for each face that is read, in a word for each voxel.
    Buffer measured_;          ///< The same for each face that has surfels.
    std::optional<uint64_t> measuredVersion_;  ///< Of the voxels; surfels change with them.
    Sampler sampler_;
};

}  // namespace voxray
