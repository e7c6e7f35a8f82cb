#pragma once

#include "passes/common/view/gbuffer.h"
#include "passes/vpls/gather_vpls/gather_types.h"
#include "passes/vpls/gather_vpls/vpl_maps.h"
#include "passes/vpls/vpls.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// Images of the G-buffer's extent, RGBA32F, that light is added to.
struct VplTarget {
    const Image& irradiance;  ///< W/m²; number of virtual lights.
    const Image& sums;        ///< sums.glsl
};

/// Irradiance of texels and of surfels from virtual point lights, by a shadow ray from each to each light of
/// its subset.
class VplLight {
 public:
    /// Lights that would bring a texel little, were nothing in the way.
    struct Dim {
        float below;      ///< Times what a subset's lights bring on average; 0: none is dim.
        bool isByChance;  ///< Whether they are looked at by chance and count for more; else never.
    };
    struct Settings {
        uint32_t block;            ///< Subsets are its square.
        float minDistanceSquared;  ///< m²: the bound.
        Dim dim;
        float endEpsilon;  ///< Voxels by which rays through voxels are moved along themselves at both ends;
                           ///< 0: they begin and end off their surfaces (docs/voxel-march.md).
        const VplMaps* maps;  ///< What hides lights, in place of shadow rays; null: these do.
        bool surfels;         ///< Whether addToSurfels() is called.
        bool starts;          ///< Whether starts() are written.
    };
    /// What the shadow rays of one run meet.
    struct Visibility {
        RayTracer* tracer;      ///< Null: nothing hides anything. Not used where there are maps.
        gpu::VoxelGrid grid{};  ///< Of the voxels; of size 0 where they meet triangles.
    };

    explicit VplLight(ProgramOwner& owner);

    /// @param texels of the G-buffer. @param maxVpls at most.
    void plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels, uint64_t maxVpls);

    /// Of the rays of a batch, a gpu::RayStart each (passes/hybrid_leaves/hybrid_types.h).
    const Buffer& starts() const { return starts_; }

    void addToTexels(PassContext& context, const Vpls& vpls, const Visibility& visibility,
                     const GBuffer& gbuffer, const VplTarget& target) const;
    /// Adds W/m² for `count` surfels with `faceNormals` (octahedral), to 4 floats each. @param reflections
    /// between a surfel and the texel that it reflects to: virtual lights of as many last bounces are left
    /// out.
    void addToSurfels(PassContext& context, const Vpls& vpls, const Visibility& visibility,
                      const Buffer& surfels, const Buffer& faceNormals, uint32_t count, uint32_t reflections,
                      const Buffer& irradiance) const;

 private:
    struct Programs {
        Programs(ProgramOwner& owner, const Defines& defines);
        Kernel mean, aim, shadows, add;
    };
    /// What the settings ask of programs.
    void define(Programs& programs, bool isUsed) const;
    void add(PassContext& context, const Vpls& vpls, const Visibility& visibility, gpu::VplBatch batch,
             uint32_t perSubset, const Programs& programs, const std::vector<Binding>& receivers,
             const std::vector<Binding>& target) const;
    uint32_t subsets() const { return settings_.block * settings_.block; }

    Settings settings_{};
    Programs texels_, surfels_;
    Buffer rays_, starts_, carried_, occluded_, means_;
};

}  // namespace voxray
