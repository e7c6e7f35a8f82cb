#pragma once

#include "passes/common/view/gbuffer.h"
#include "passes/vpls/gather_vpls/gather_types.h"
#include "passes/vpls/gather_vpls/vpl_shadow_maps.h"
#include "passes/vpls/vpls.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// Images that a gather adds to: of the G-buffer's extent, RGBA32F.
struct VplTarget {
    const Image& irradiance;    ///< W/m²; number of virtual lights.
    const Image& texelMoments;  ///< Sums of sampleMoments() (sample_moments.glsl).
};

/// Irradiance at texels and at surfels from virtual point lights: a shadow ray from each receiver to each
/// light of its subset (interleaved sampling, Segovia et al. 2006).
class VplGather {
 public:
    /// What becomes of lights that bring little.
    enum class DimLights {
        Sampled,         ///< By unoccluded irradiance at the receiver, in proportion to it (unbiased).
        LeftOut,         ///< By unoccluded irradiance at the receiver.
        LeftOutByPower,  ///< By the luminance of the light's flux (Sun and Agu 2015, section 3.2).
    };
    /// Which lights get no shadow ray.
    struct DimLightCulling {
        float threshold;  ///< Times the mean of the subset's lights; 0: no culling.
        DimLights kind;
    };
    struct Settings {
        uint32_t block;            ///< Edge of an interleaving block, texels.
        float minDistanceSquared;  ///< The bound, m².
        DimLightCulling culling;
        float endEpsilon;  ///< Voxels by which voxel rays are shortened at both ends; 0: they start and end
                           ///< off their surfaces (docs/voxel-march.md).
        const VplShadowMaps* shadowMaps;  ///< In place of shadow rays; null: shadow rays.
        bool gathersAtSurfels;            ///< Whether gatherAtSurfels() is called.
        bool writesStarts;                ///< Whether starts() are written.
    };
    /// What the shadow rays of a frame are traced through.
    struct Visibility {
        RayTracer* tracer;      ///< Null: nothing occludes. Not used with shadow maps.
        gpu::VoxelGrid grid{};  ///< Of the voxels; its voxelSize is 0 for triangles.
    };

    explicit VplGather(ProgramOwner& owner);

    /// @param texels of the G-buffer. @param maxVpls at most.
    void plan(PassPlan& plan, const Settings& settings, glm::uvec2 texels, uint64_t maxVpls);

    /// A gpu::RayStart for each ray of a batch (passes/hybrid_leaves/hybrid_types.h).
    const Buffer& starts() const { return starts_; }

    void gatherAtTexels(PassContext& context, const Vpls& vpls, const Visibility& visibility, const GBuffer& gbuffer,
                        const VplTarget& target) const;
    /// Adds irradiance, W/m², to 4 floats for each of `count` surfels with `faceNormals` (octahedral). @param
    /// reflections between surfel and texel: virtual lights of the last so many bounces are left out.
    void gatherAtSurfels(PassContext& context, const Vpls& vpls, const Visibility& visibility, const Buffer& surfels,
                         const Buffer& faceNormals, uint32_t count, uint32_t reflections,
                         const Buffer& irradiance) const;

 private:
    struct Programs {
        Programs(ProgramOwner& owner, const Defines& defines);
        Kernel computeMean, generateRays, testShadowMaps, accumulate;
    };
    /// Defines programs by the settings.
    void define(Programs& programs, bool isUsed) const;
    /// The mean that dim lights are compared with.
    void recordMean(PassContext& context, const Vpls& vpls, const gpu::VplBatch& subset, const Programs& programs,
                    const std::vector<Binding>& receiverBindings) const;
    void gather(PassContext& context, const Vpls& vpls, const Visibility& visibility, gpu::VplBatch batch,
                uint32_t receiversPerSubset, const Programs& programs, const std::vector<Binding>& receiverBindings,
                const std::vector<Binding>& targetBindings) const;
    uint32_t subsetCount() const { return settings_.block * settings_.block; }

    Settings settings_{};
    Programs texelPrograms_, surfelPrograms_;
    Kernel meanPower_;
    Buffer rays_, starts_, contributions_, occluded_, meanLuminance_;
};

}  // namespace voxray
