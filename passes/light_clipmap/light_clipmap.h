#pragma once

#include "passes/common/clipmap/clipmap_voxels.h"
#include "passes/common/clipmap/radiance_clipmap.h"
#include "passes/common/lights/shadow_map.h"
#include "passes/common/radiance/cone_bounces.h"
#include "passes/common/triangle_walk/triangle_walk.h"
#include "passes/common/voxels/flux_accumulator.h"

namespace voxray {

/// The layouts of radiance voxels that it can fill.
enum class ClipmapLayout {
    Clipmap = int(RadianceLayout::Clipmap),
    ClipmapTextures = int(RadianceLayout::ClipmapTextures)
};
template <>
struct EnumNames<ClipmapLayout> {
    static constexpr std::array names{std::pair{ClipmapLayout::Clipmap, "clipmap"},
                                      std::pair{ClipmapLayout::ClipmapTextures, "clipmap_textures"}};
};

/// Lights the surface voxels of a clipmap by shadow maps, while it visits the triangles in them, and fills
/// radiance voxels with what they reflect. Docs: docs/clipmap.md.
class LightClipmap final : public Pass {
 public:
    static constexpr const char* kName = "light_clipmap";
    static constexpr const char* kHelp =
        "Lights the voxels of voxelize_clipmap: the part of each triangle in a voxel is tested against a "
        "shadow "
        "map of every light, and what voxels reflect is made radiance voxels for gather_cones, which bring "
        "one "
        "bounce more than 'bounces'. What scrolled in is lit in each frame; all of the "
        "windows where a light or a surface has moved, and with bounces wherever anything scrolled in. No "
        "emissive surfaces as lights and no environment: "
        "they have no single viewpoint. Biased by: voxel size, so distance from the camera; "
        "shadow_resolution. Source: Arnebäck 2017, section 4.1.2, after Panteleev 2014.";
    struct Params : ClipmapLevelParams, ConeBounceParams {
        uint32_t shadowResolution = 512;
        ClipmapLayout layout = ClipmapLayout::Clipmap;
        static constexpr auto schema() {
            return std::tuple_cat(
                std::tuple{
                    field("shadow_resolution", &Params::shadowResolution,
                          "Texels along an edge of each shadow map; a point light has six.", 2u, 4096u),
                    field("layout", &Params::layout,
                          "How voxels are stored: clipmap, in a buffer; clipmap_textures, as published "
                          "in Arnebäck 2017: in a 3D texture that the device's sampler filters.")},
                ClipmapLevelParams::schema(), ConeBounceParams::schema());
        }
    };

    explicit LightClipmap(const Params& params)
        : params_(params), walk_(makeExactWalk()), bounces_(params.bounceCones) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Measures light where windows or, with `moved`, lights or surfaces have changed, and fills all levels.
    void relight(PassContext& context, bool moved);
    /// Direct light of the voxels in boxes of a level. @param voxels these, or others besides.
    VoxelIrradiance light(PassContext& context, const SurfaceVoxels& voxels,
                          const std::vector<VoxelBox>& boxes);
    /// Fills boxes of a level with what the voxels in them reflect.
    void reflect(PassContext& context, uint32_t level, const SurfaceVoxels& voxels,
                 const std::vector<VoxelBox>& boxes, const VoxelIrradiance& light,
                 const LargeBuffer& indirect);
    /// Fills the levels beyond the first that is held whole, each from the one below.
    void filter(PassContext& context);

    Params params_;
    Port<const ClipmapVoxels> clipmap_;
    Port<RadianceVoxels> radiance_;
    std::vector<LightSource> sources_;
    RadianceClipmap storage_;
    ShadowMaps shadowMaps_;
    std::unique_ptr<TriangleWalk> walk_;
    Program light_, area_, window_, level_;
    FluxAccumulator flux_;
    ConeBounces bounces_;
    std::optional<uint64_t> sceneVersion_;  ///< Of the last frame.
    uint64_t updatedVoxels_ = 0;            ///< In this frame.
};

}  // namespace voxray
