#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "passes/cache/radiance_cache.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/final_gather/merged_voxels/irradiance_tree.h"

namespace voxray {

/// Storage from which a final gather reads light.
enum class GatherSource { Voxels, MergedVoxels, RadianceCache };
template <>
struct EnumNames<GatherSource> {
    static constexpr std::array names{std::pair{GatherSource::Voxels, "voxels"},
                                      std::pair{GatherSource::MergedVoxels, "merged_voxels"},
                                      std::pair{GatherSource::RadianceCache, "radiance_cache"}};
};

/// Stored light at the hits of gather rays: its ports, and the definitions and bindings of its shaders.
class StoredLight {
 public:
    /// @param readsVoxelDirect whether direct light is read from voxels, too. @param minSamples samples that
    /// a cell of the cache needs.
    StoredLight(Pass& pass, GatherSource source, bool readsVoxelDirect, uint32_t minSamples);

    /// Whether direct light is stored, too.
    bool holdsDirect(const PassPlan& plan) const;
    /// Resource::lightBounces.
    std::optional<uint32_t> bounces(const PassPlan& plan) const;
    /// Of shaders that include stored_light.glsl.
    Defines defines() const;
    /// Brings the light up to date. @return its bindings.
    std::vector<Binding> update(PassContext& context);

 private:
    const GatherSource source_;
    const bool readsVoxelDirect_;
    const uint32_t minSamples_;
    In<VoxelLevels> voxels_;
    In<VoxelIrradiance> irradiance_;
    In<IrradianceTree> tree_;
    In<RadianceCache> cache_;
    std::optional<FaceIrradiance> faces_;  ///< Of voxels.
};

}  // namespace voxray
