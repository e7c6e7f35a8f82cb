#include <array>
#include <utility>

#include "graph/registry.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/final_gather/final_gather.h"

namespace voxray {

enum class DirectAtHits { Voxels, ShadowRays };

template <>
struct EnumNames<DirectAtHits> {
    static constexpr std::array names{std::pair{DirectAtHits::Voxels, "voxels"},
                                      std::pair{DirectAtHits::ShadowRays, "shadow_rays"}};
};

/// Indirect light by a final gather: rays find what each pixel sees, voxels tell how bright that is. Source:
/// Magalhães 2020 (hybrid of rays and voxels). filter_irradiance lowers its noise.
class GatherRays final : public Pass {
 public:
    static constexpr const char* kName = "gather_rays";
    static constexpr const char* kHelp =
        "Gathers indirect light by shading ray hits with voxel irradiance. The hits of trace_gather_rays "
        "take the irradiance of the voxels there and their own albedo. Biased by: voxel size (light at the "
        "hits is as coarse as voxels, not at the pixel; with `direct_at_hits: shadow_rays` only indirect "
        "light is; hits near the pixel are measured by paths). Noisy by: rays_per_block; filter_irradiance "
        "lowers that. Lambert surfaces only. Reports how many hits are on faces that no injection lit.";
    struct Params {
        DirectAtHits directAtHits = DirectAtHits::Voxels;
        uint32_t lightSamples = 1;
        float nearFieldVoxels = 2;
        static constexpr auto schema() {
            return std::tuple{
                field(
                    "direct_at_hits", &Params::directAtHits,
                    "Direct light at the hits. voxels: as coarse as voxels. shadow_rays: exact, by a shadow "
                    "ray from each hit to each light; voxels bring indirect light alone."),
                field("light_samples", &Params::lightSamples,
                      "Shadow rays to the emissive surfaces, and to the environment, from each hit where "
                      "direct light is measured.",
                      1u, 256u)
                    .onlyWith(oneOf(&Params::directAtHits, {DirectAtHits::ShadowRays}),
                              noneOf(&Params::nearFieldVoxels, {0.0f})),
                field("near_field_voxels", &Params::nearFieldVoxels,
                      "A ray shorter than this many voxels, or one that hits where no light was injected, "
                      "goes on as a path does instead of reading the voxel there, up to three times. 0: "
                      "every hit is read.",
                      0.0f, 64.0f)};
        }
    };

    explicit GatherRays(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool shadowRays() const { return params_.directAtHits == DirectAtHits::ShadowRays; }

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelIrradiance> irradiance_{*this, "irradiance", "light that arrives at the voxels' surfaces"};
    FinalGather gather_{*this};
    FaceIrradiance faces_{*this};
    Buffer grid_;  ///< gpu::VoxelGrid
};

void GatherRays::plan(PassPlan& plan) {
    FinalGather::Settings settings{kName};
    settings.shadowRays = shadowRays();
    settings.lightSamples = params_.lightSamples;
    settings.nearFieldCells = params_.nearFieldVoxels;
    settings.storedBounces = plan[irradiance_].lightBounces;
    gather_.plan(plan, settings);
    plan.buffer(grid_, "grid of voxels", sizeof(gpu::VoxelGrid));
}

void GatherRays::record(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    if (context.changed(voxels_) || context.changed(irradiance_)) {
        const VoxelIrradiance& light = context[irradiance_];
        faces_.update(context.stream, voxels, light.area, light.indirect,
                      shadowRays() ? nullptr : &light.direct);
        context.stream.upload(grid_, std::vector{voxels.grid});
    }
    gather_.record(context, voxels.bindings({faces_.binding(), {"grid", grid_}}));
}

VOXRAY_REGISTER_PASS(GatherRays);

}  // namespace voxray
