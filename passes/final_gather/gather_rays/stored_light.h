#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "passes/cache/radiance_cache.h"
#include "passes/common/voxels/face_irradiance.h"
#include "passes/final_gather/merged_voxels/irradiance_tree.h"

namespace voxray {

/// Where a final gather reads light.
enum class GatherSource { Voxels, MergedVoxels, RadianceCache };
template <>
struct EnumNames<GatherSource> {
    static constexpr std::array names{std::pair{GatherSource::Voxels, "voxels"},
                                      std::pair{GatherSource::MergedVoxels, "merged_voxels"},
                                      std::pair{GatherSource::RadianceCache, "radiance_cache"}};
};

/// The light that is stored at the hits of gather rays: the ports that bring it, and what shaders that
/// include stored_light.glsl are compiled with and given.
class StoredLight {
 public:
    /// @param voxelsBringDirect false: of voxels' light indirect light alone is read.
    /// @param minSamples of a cell of the cache that is read.
    StoredLight(Pass& pass, GatherSource source, bool voxelsBringDirect, uint32_t minSamples);

    void plan(PassPlan& plan);
    /// Whether it holds direct light, too.
    bool holdsDirect(const PassPlan& plan) const;
    /// Resource::lightBounces.
    std::optional<uint32_t> bounces(const PassPlan& plan) const;
    Defines defines() const;
    SpecializationConstants constants() const;
    /// What the light is now.
    std::vector<Binding> bindings(PassContext& context);

 private:
    const GatherSource source_;
    const bool voxelsBringDirect_;
    const uint32_t minSamples_;
    In<SurfaceVoxels> voxels_;
    In<VoxelIrradiance> irradiance_;
    In<IrradianceTree> tree_;
    In<RadianceCache> cache_;
    std::optional<FaceIrradiance> faces_;  ///< Of voxels.
    Buffer grid_;                          ///< Of voxels: gpu::VoxelGrid.
};

}  // namespace voxray
