#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/lights/pane_transmittance.h"
#include "passes/published/magalhaes_2020/packed_voxels.h"

namespace voxray {
namespace {

/// Bounds the memory of rays and intensities to 60 MiB.
constexpr uint32_t kMaxPackedBatchRays = 1u << 20;
constexpr float kTMin = 0.02f;  // m (listing 7.7).

}  // namespace

/// Light tracing as published in Magalhães 2020, sections 3.3.1 and 4.3.
///  - Rays leave a spot light through a planar grid that spans 90 degrees about its axis (listing 4.4). The
///    thesis's light has no cone; rays outside of this one's are not traced.
///  - A hit deposits intensity * cosine / length² in its voxel, by the voxel's mean normal and the length of
///    this segment only.
///  - Secondary rays are mirrored about the mean normal; their intensity is the irradiance at the hit times
///    the albedo there. Its unit is not that of an intensity: the formula has m² instead of sr.
///
/// The text is followed where the listings differ from it: listing 7.7 stores a debug color, disables
/// secondary rays, starts them at the origin, and omits the albedo, which sections 3.2.7.1 and 4.3.2.2 have.
/// Empty voxels, whose word of 0 would decode to the normal (-1, -1, -1), are misses, as the listing intends.
class InjectPackedLightRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_packed_light_rays";
    static constexpr const char* kHelp =
        "Traces a planar grid of rays from one spot light into packed voxels. "
        "The irradiance of each hit is merged into the voxel's word, then the ray is mirrored. "
        "As published in Magalhães 2020 (section 4.3), for comparison: use inject_light_rays instead. "
        "Biased by: voxel size; write: all rays in a voxel have equal weight, whatever area they represent; "
        "distance falloff restarts with each segment; 8 bits of white. "
        "Noisy by: nothing, but moving_average and none depend on the order of threads. "
        "Surfaces between the grid's rays or beyond 45 degrees, and voxels that voxelization missed, remain black. "
        "Source: Magalhães 2020, sections 3.3.1 and 4.3.";
    struct Params : PackedWriteParams {
        uint32_t raysPerLight = 262144;
        uint32_t bounces = 0;
        float white = 3.14159265f;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{
                    field("rays_per_light", &Params::raysPerLight, "Rays of the grid; a square number.", 1u, 1u << 26),
                    field("bounces", &Params::bounces, "Mirrored rays after a ray's first hit. 0 and 1 as published.",
                          0u, 64u),
                    field("white", &Params::white,
                          "Irradiance, W/m², of the maximum 8-bit value, "
                          "to which brighter values are clamped. "
                          "pi as published: a white surface then reflects a radiance of 1.",
                          1e-6f, 1e9f)},
                PackedWriteParams::schema());
        }
    };

    explicit InjectPackedLightRays(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Index of the scene's only light. @throws Error where there is none, several, or another kind than a
    /// spot light.
    static uint32_t spotLight(const SceneState& scene);

    const Params params_;
    In<PackedVoxels> voxels_{*this, "packed_voxels", "normals and albedos, one word a voxel"};
    Out<PackedLight> light_{*this, "packed_light", "light that arrives in voxels, one word a voxel"};
    Kernel generateGridRays_{*this, "generate_grid_rays.comp"};
    Kernel depositIrradiance_{*this, "deposit_irradiance.comp", params_.defines()};
    uint32_t raysPerEdge_ = 0;
    Buffer rays_, hits_, intensities_;
    PaneTransmittance paneTransmittance_{*this};
};

uint32_t InjectPackedLightRays::spotLight(const SceneState& scene) {
    const std::vector<LightSource> sources = requireLightSources(scene, kName);
    const LightSource& first = sources.front();
    if (sources.size() > 1 || first.kind != LightSource::Punctual || scene.lights[first.light].type != LightType::Spot)
        throw Error("{}: it takes one spot light and no other light, as published", kName);
    return first.light;
}

void InjectPackedLightRays::plan(PassPlan& plan) {
    spotLight(*plan.frame.scene);
    raysPerEdge_ = uint32_t(std::lround(std::sqrt(double(params_.raysPerLight))));
    if (raysPerEdge_ * raysPerEdge_ != params_.raysPerLight)
        throw Error("{}: rays_per_light: {} is no square of a whole number; the nearest is {}", kName,
                    params_.raysPerLight, raysPerEdge_ * raysPerEdge_);

    PackedLight& light = plan[light_];
    light.white = params_.white;
    light.lightBounces = params_.bounces;
    plan.buffer(light.irradiance, "packed irradiance", plan[voxels_].bytes());
    const uint64_t batch = std::min(params_.raysPerLight, kMaxPackedBatchRays);
    plan.scratchBuffer(rays_, "light rays", batch * sizeof(Ray));
    plan.scratchBuffer(hits_, "light ray hits", batch * sizeof(Hit));
    paneTransmittance_.plan(plan, batch);
    plan.scratchBuffer(intensities_, "intensities of light rays", batch * sizeof(glm::vec3));
}

void InjectPackedLightRays::record(PassContext& context) {
    const PackedVoxels& voxels = context[voxels_];
    const PackedLight& light = context[light_];
    const uint32_t lightIndex = spotLight(*context.frame.scene);
    context.stream.fill(light.irradiance, 0);
    for (uint32_t first = 0; first < params_.raysPerLight; first += kMaxPackedBatchRays) {
        const uint32_t count = std::min(kMaxPackedBatchRays, params_.raysPerLight - first);
        context.dispatch(generateGridRays_, count,
                         {context.scene,
                          {"rays", rays_},
                          {"intensities", intensities_},
                          {"light", lightIndex},
                          {"raysPerEdge", raysPerEdge_},
                          {"firstRay", first},
                          {"batchRays", count},
                          {"tMin", kTMin}});
        for (uint32_t bounce = 0; bounce <= params_.bounces; ++bounce) {
            context.tracer.closestHit(context.stream, rays_, hits_, count,
                                      bounce == 0 ? Coherence::Coherent : Coherence::Incoherent);
            if (bounce == 0) paneTransmittance_.apply(context, rays_, intensities_, 3, count, &hits_);
            context.dispatch(depositIrradiance_, count,
                             {{"rays", rays_},
                              {"intensities", intensities_},
                              {"hits", hits_},
                              {"NormalsRef", voxels.normals.ref()},
                              {"AlbedosRef", voxels.albedos.ref()},
                              {"IrradianceRef", light.irradiance.ref()},
                              {"grid", voxels.grid},
                              {"batchRays", count},
                              {"isLast", bounce == params_.bounces},
                              {"white", light.white},
                              {"tMin", kTMin}});
        }
    }
}

VOXRAY_REGISTER_PASS(InjectPackedLightRays);

}  // namespace voxray
