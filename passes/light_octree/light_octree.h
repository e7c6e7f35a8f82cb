#pragma once

#include "passes/common/lights/rsm.h"
#include "passes/common/radiance/brick_radiance.h"

namespace voxray {

/// Light into the leaves of an octree of bricks, and up its levels, as published in Arnebäck 2017, sections
/// 3.2.3 and 3.2.4: each texel of a light's reflective shadow map lights the leaf that it sees, by the leaf's
/// own color and normal.
class LightOctree final : public Pass {
 public:
    static constexpr const char* kName = "light_octree";
    static constexpr const char* kHelp =
        "Lights the leaves of voxelize_octree by the texels of render_rsm that see them, and filters "
        "upwards: "
        "radiance voxels for gather_stepped_cones or gather_cones. As published in Arnebäck 2017 (sections "
        "3.2.3 and 3.2.4), for comparison: an injection and filter_voxels with layout svo are the method to "
        "use. Point, spot and directional lights; no bounces, and nothing that surfaces emit. Biased by: "
        "voxel size; rsm_resolution (leaves between texels stay dark); mean normals of leaves; 8 bits. "
        "Source: Arnebäck 2017, section 3.2.3.";
    struct Params {
        static constexpr auto schema() { return std::tuple{}; }
    };

    explicit LightOctree(const Params&) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Radiance of the leaves that a light sees, added to `leafRadiance_`.
    void scatter(PassContext& context, uint32_t source);

    Port<const BrickOctree> octree_;
    Port<const Rsm> rsm_;
    Port<RadianceVoxels> radiance_;
    BrickRadiance bricks_;
    Program scatter_, resolve_, write_;
    LargeBuffer sums_;                 ///< gpu::LeafSum a leaf, of one light.
    LargeBuffer leafRadiance_;         ///< W/(m² sr), three floats a leaf.
    Buffer brightest_;                 ///< Of what a texel of a light brings, as the bits of a float.
    std::optional<uint64_t> version_;  ///< Of the octree.
};

}  // namespace voxray
