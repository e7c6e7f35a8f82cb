#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "base/schema.h"

namespace voxray {

/// Storage from which a final gather reads light.
enum class GatherSource { Voxels, MergedVoxels, RadianceCache, HitFaces };
template <>
struct EnumNames<GatherSource> {
    static constexpr std::array names{
        std::pair{GatherSource::Voxels, "voxels"}, std::pair{GatherSource::MergedVoxels, "merged_voxels"},
        std::pair{GatherSource::RadianceCache, "radiance_cache"}, std::pair{GatherSource::HitFaces, "hit_faces"}};
};

enum class DirectAtHits { Voxels, ShadowRays };
template <>
struct EnumNames<DirectAtHits> {
    static constexpr std::array names{std::pair{DirectAtHits::Voxels, "voxels"},
                                      std::pair{DirectAtHits::ShadowRays, "shadow_rays"}};
};

/// Parameters of a pass that shades hits by stored light; it adds schema() to its own with std::tuple_cat.
struct StoredLightParams {
    GatherSource source = GatherSource::Voxels;
    DirectAtHits directAtHits = DirectAtHits::Voxels;
    uint32_t lightSamples = 1;
    float nearFieldCells = 2;
    uint32_t minSamples = 1;
    static constexpr auto schema() {
        using P = StoredLightParams;
        return std::tuple{
            field("source", &P::source,
                  "Storage of light. voxels: faces of surface voxels, filled by any injection. merged_voxels: "
                  "the trees of merge_voxels. radiance_cache: the hashed cells of update_radiance_cache. "
                  "hit_faces: the voxel faces of light_hit_faces."),
            field("direct_at_hits", &P::directAtHits,
                  "Direct light at the hits. voxels: from voxels, as coarse as they are. shadow_rays: "
                  "exact, by a shadow ray from each hit to each light; only indirect light is read from voxels.")
                .onlyWith(oneOf(&P::source, {GatherSource::Voxels})),
            field("light_samples", &P::lightSamples,
                  "Shadow rays to the emissive surfaces, and to the environment, "
                  "from each hit where direct light is measured.",
                  1u, 256u)
                .onlyWith(oneOf(&P::directAtHits, {DirectAtHits::ShadowRays}), noneOf(&P::nearFieldCells, {0.0f}),
                          oneOf(&P::source, {GatherSource::MergedVoxels})),
            field("near_field_cells", &P::nearFieldCells,
                  "Paths continue from hits closer than this, in voxels or cells of the cache, "
                  "and from hits where no light is stored: up to three times, with a radiance cache or hit faces "
                  "up to seven. "
                  "0: every hit reads stored light, and is black where there is none.",
                  0.0f, 64.0f),
            field("min_samples", &P::minSamples,
                  "Samples that a cell needs for paths to end there; "
                  "with a near_field_cells of 0 cells with fewer are read, too.",
                  1u, 65536u)
                .onlyWith(oneOf(&P::source, {GatherSource::RadianceCache}))};
    }
};

}  // namespace voxray
