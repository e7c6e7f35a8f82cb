#pragma once

#include "passes/common/lights/pane_tint.h"
#include "passes/common/packed_voxels/packed_voxels.h"

namespace voxray {

/// Light tracing as published in Magalhães 2020, sections 3.3.1 and 4.3.
///  - Rays leave a spot light through a planar grid that spans 90 degrees about its axis (listing 4.4). The
///    thesis's light has no cone; rays outside of this one's are not traced.
///  - A hit leaves intensity * cosine / length² in its voxel, by the voxel's mean normal and the length of
///    this segment alone.
///  - Secondary rays go on mirrored about the mean normal; their intensity is the irradiance at the hit,
///  times
///    the albedo there. By units this is no intensity: metres stand where steradians should.
///
/// The text is followed where the listings differ from it: listing 7.7 stores a debug color, disables
/// secondary rays, starts them at the origin, and leaves the albedo out, which sections 3.2.7.1 and 4.3.2.2
/// have. Empty voxels, whose word of 0 would be the normal (-1, -1, -1), are the misses that the listing
/// means them to be.
class InjectPackedLightRays final : public Pass {
 public:
    static constexpr const char* kName = "inject_packed_light_rays";
    static constexpr const char* kHelp =
        "Traces a planar grid of rays from one spot light and merges the irradiance of each hit into the "
        "voxel's one word; then they are mirrored. As published in Magalhães 2020 (section 4.3), for "
        "comparison: inject_light_rays is the method to use. Biased by: voxel size; write: all rays of a "
        "voxel count alike, whatever area they stand for; falloff that begins again with each segment; 8 "
        "bits of white. Noisy by: nothing, but moving_average and none depend on the order of threads. "
        "Leaves "
        "unlit: what lies between the grid's rays or beyond 45 degrees, and voxels that voxelization missed. "
        "Source: Magalhães 2020, sections 3.3.1 and 4.3.";
    struct Params : PackedWriteParams {
        uint32_t raysPerLight = 262144;
        uint32_t bounces = 0;
        float white = 3.14159265f;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{
                    field("rays_per_light", &Params::raysPerLight,
                          "Rays of the grid: the square of a whole number, of rays along its edge.", 1u,
                          1u << 26),
                    field("bounces", &Params::bounces,
                          "Mirrored rays after a ray's first hit. 0 and 1 as published.", 0u, 64u),
                    field("white", &Params::white,
                          "Irradiance, W/m², that the largest of 8 bits stands for; what is brighter is "
                          "clamped. pi, as published: a white surface then sends out a radiance of 1.",
                          1e-6f, 1e9f)},
                PackedWriteParams::schema());
        }
    };

    explicit InjectPackedLightRays(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const PackedVoxels> voxels_;
    Port<PackedLight> light_;
    uint32_t raysPerEdge_ = 0;
    Program gridRays_, deposit_;
    Buffer rays_, hits_, intensities_;
    PaneTint tint_;
};

}  // namespace voxray
